//! What the engine sends a page for each scene of a folder, as files of JSON lines, to hold what it sends in a browser against.

use std::error::Error;
use std::ops::ControlFlow;
use std::path::Path;
use std::{env, fs};

use tumble_lab::{Request, Session};

fn main() -> Result<(), Box<dyn Error>> {
    let folders: Vec<String> = env::args().skip(1).collect();
    let [scenes, out] = &folders[..] else { return Err("messages SCENES OUT".into()) };
    fs::create_dir_all(out)?;
    for entry in fs::read_dir(scenes)? {
        let folder = entry?.path();
        if folder.join("scene.toml").is_file() {
            one(&folder, Path::new(out))?;
        }
    }
    Ok(())
}

/// Writes the request, as the page sends it, and all messages that come of it.
fn one(folder: &Path, out: &Path) -> Result<(), Box<dyn Error>> {
    let name = folder.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let mut request = Request {
        name: name.clone(),
        scene: fs::read_to_string(folder.join("scene.toml"))?,
        ..Request::default()
    };
    for file in fs::read_dir(folder)? {
        let file = file?;
        let name = file.file_name().to_string_lossy().into_owned();
        if name.ends_with(".csv") {
            request.files.insert(name, fs::read(file.path())?);
        }
    }
    fs::write(out.join(format!("{name}.request")), request.bytes())?;
    let mut session = Session::new(request);
    let mut lines = vec![];
    loop {
        let goes_on = session.advance(|_, _| ControlFlow::Continue(()));
        lines.push(session.take());
        if !goes_on {
            break;
        }
    }
    fs::write(out.join(format!("{name}.json")), lines.join("\n"))?;
    Ok(())
}
