//! The peer: EXUDYN, geometrically exact beams in C++ behind Python, on the same cases by the scripts in benches/peer
//! of this package.

use ancf14_testing::curves::Curves;
use ancf14_testing::root;
use std::path::PathBuf;
use std::process::Command;

/// Its Python, with it installed.
#[derive(Clone, Debug)]
pub struct Peer {
    python: PathBuf,
}

/// What a script finds.
pub struct Found {
    /// CPU time of the solve alone, s: the least of several.
    pub seconds: f64,
    /// What it solved for.
    pub curves: Curves,
}

impl Peer {
    /// Where scripts/peer-env.sh has put it, if it has.
    pub fn find() -> Option<Self> {
        let target = std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), PathBuf::from);
        let environment = target.join("peer-env");
        // Written last, when all is installed.
        environment.join("made-from.txt").exists().then(|| Self { python: environment.join("bin/python") })
    }

    /// Runs the script benches/peer/`case`.py: a line `# cpu SECONDS`, then a table.
    pub fn run(&self, case: &str, arguments: &[&str]) -> Found {
        let script = format!("{}/benches/peer/{case}.py", env!("CARGO_MANIFEST_DIR"));
        let mut command = Command::new(&self.python);
        let output = command.arg(script).args(arguments).env("OMP_NUM_THREADS", "1").output().unwrap();
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let seconds = text.lines().find_map(|line| line.strip_prefix("# cpu ")?.parse().ok());
        let complaint = || String::from_utf8_lossy(&output.stderr).into_owned();
        let seconds = seconds.unwrap_or_else(|| panic!("the peer fails on {case} {arguments:?}: {}", complaint()));
        Found { seconds, curves: Curves::read(&text) }
    }
}
