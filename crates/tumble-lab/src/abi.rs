//! The engine as functions for a host: numbers and bytes in linear memory. An instance has one scene at a time.
//!
//! `room` is where the host writes a request, `begin` takes it, `advance` does a stage, `take` and `taken` are where and how long
//! that is which came of it, and `end` forgets the scene. The only unchecked thing is that their names are their own.

#![allow(unsafe_code)]
// The host reaches them by their names.
#![allow(unreachable_pub)]

use std::cell::{Cell, RefCell};
use std::ops::ControlFlow;

use crate::request::Request;
use crate::session::Session;

/// The host is told of so many steps at once.
const STEPS_A_WORD: u32 = 16;

thread_local! {
    static INPUT: RefCell<Vec<u8>> = const { RefCell::new(vec![]) };
    static OUTPUT: RefCell<String> = const { RefCell::new(String::new()) };
    static SESSION: RefCell<Option<Session>> = const { RefCell::new(None) };
}

#[cfg(target_arch = "wasm32")]
#[link(wasm_import_module = "lab")]
unsafe extern "C" {
    /// A run is at that time of that, s.
    safe fn reached(time: f64, until: f64);
    /// The program has gone wrong: why, so many bytes of text at that place. It ends with that.
    safe fn failed(from: *const u8, bytes: usize);
}

/// There is nobody to tell.
#[cfg(not(target_arch = "wasm32"))]
fn reached(_: f64, _: f64) {}

/// A panic says nothing by itself here. What ends without one has found no memory.
#[cfg(target_arch = "wasm32")]
fn tell_failures() {
    std::panic::set_hook(Box::new(|panic| {
        let said = panic.to_string();
        failed(said.as_ptr(), said.len());
    }));
}

/// Panics are told as everywhere.
#[cfg(not(target_arch = "wasm32"))]
fn tell_failures() {}

/// Where a request of so many bytes is to be written.
#[unsafe(no_mangle)]
pub extern "C" fn room(bytes: usize) -> *mut u8 {
    INPUT.with_borrow_mut(|input| {
        *input = vec![0; bytes];
        input.as_mut_ptr()
    })
}

/// Takes the request that was written, in the place of any before it: 1, or 0 where it is none.
#[unsafe(no_mangle)]
pub extern "C" fn begin() -> u32 {
    tell_failures();
    let request = Request::of(&INPUT.take());
    let is_one = request.is_some();
    SESSION.set(request.map(Session::new));
    u32::from(is_one)
}

/// Does the next stage: 1 while there is more to do.
#[unsafe(no_mangle)]
pub extern "C" fn advance() -> u32 {
    let steps = Cell::new(0_u32);
    let tell = |time: f64, until: f64| {
        steps.set(steps.get().wrapping_add(1));
        if steps.get().is_multiple_of(STEPS_A_WORD) {
            reached(time, until);
        }
        ControlFlow::Continue(())
    };
    SESSION
        .with_borrow_mut(|session| u32::from(session.as_mut().is_some_and(|session| session.advance(tell))))
}

/// Where that is which came of the stages since this was last called: JSON.
#[unsafe(no_mangle)]
pub extern "C" fn take() -> *const u8 {
    let text = SESSION.with_borrow_mut(|session| session.as_mut().map(Session::take).unwrap_or_default());
    OUTPUT.with_borrow_mut(|output| {
        *output = text;
        output.as_ptr()
    })
}

/// How many bytes it has.
#[unsafe(no_mangle)]
pub extern "C" fn taken() -> usize {
    OUTPUT.with_borrow(String::len)
}

/// Forgets the scene.
#[unsafe(no_mangle)]
pub extern "C" fn end() {
    SESSION.set(None);
    OUTPUT.take();
}
