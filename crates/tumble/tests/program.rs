//! The tests of the program, in one: they are built once and share the machine's cores.

mod command;
mod common;
mod documents;
mod equilibrium;
mod forces;
mod honest;
mod interrupted;
mod replacing;
mod report;
mod reserved_names;
mod rest;
mod scenes;
mod tools;
