//! Files that stand beside the scenes of tests.

use std::io;

use tumble_scene::Files;

/// Files that tests read.
pub(crate) struct Beside;

impl Files for Beside {
    fn read(&self, relative: &str) -> io::Result<Vec<u8>> {
        let text: &[u8] = match relative {
            "gust.csv" => b"# measured on a roof\nt [ms], w [km/h], n\n0, 0, 1\n500, 36, 2\n1000, 18, 3\n",
            "words.csv" => b"t [s],w [m/s]\n0,1\n1,fast\n",
            "order.csv" => b"t [s],w [m/s]\n0,1\n2,1\n1,5\n",
            "uneven.csv" => b"t [s],w [m/s]\n0,1\n1\n",
            "short.csv" => b"t [s],w [m/s]\n0,1\n",
            "semicolons.csv" => b"t [s];w [m/s]\n0;1\n1;2\n",
            "units.csv" => b"t [sek],w [m / s]\n0,1\n1,2\n",
            "latin.csv" => b"t [s],w [m/s]\n0,\xff\n",
            "infinite.csv" => b"t [s],w [m/s]\n0,1\n1,inf\n",
            _ => return Err(io::Error::new(io::ErrorKind::NotFound, "there is no such file")),
        };
        Ok(text.to_vec())
    }
}
