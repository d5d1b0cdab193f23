//! A path that is followed by its arc length: along it, nothing but its parameter changes what acts.

use super::Checker;
use crate::fmi::variable::Causality;
use crate::model::file::entries::switch::SwitchSpec;

impl Checker<'_> {
    /// No input of a host, and nothing that engages or releases.
    pub(super) fn check_path(&mut self) {
        let document = self.document;
        if !document.follows_arc_length() {
            return;
        }
        for row in document.parameters().iter().filter(|row| row.variable.causality == Causality::Input) {
            let message = "a path that is followed by its arc length has no inputs";
            let label = "this is given by a host";
            let help = "only `t` changes along the path: make it an expression of `t`, or set follow = \"time\"";
            self.mistake(document.place(row.number), message, label, help);
        }
        let joints = document.joints.iter().filter_map(|joint| joint.switch.as_ref());
        let drives = document.drives.iter().filter_map(|drive| drive.switch.as_ref());
        let locks = document.locks.iter().map(|lock| &lock.switch);
        let switches: Vec<&SwitchSpec> = joints.chain(drives).chain(locks).collect();
        for switch in switches.into_iter().filter(|switch| !switch.input) {
            let message = "a path that is followed by its arc length engages and releases nothing";
            let label = "this may engage or release where `t` turns back";
            let help = "remove `active` and locks, or set follow = \"time\"";
            self.mistake(document.place(switch.active), message, label, help);
        }
    }
}
