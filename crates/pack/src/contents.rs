//! What goes into an FMU beside its libraries and what follows from the variable table.

use crate::small::Origin;

/// Licences of all that is linked into the library; made by scripts/licenses.py.
pub const LICENCES: &str = include_str!("../../../licenses/license.txt");

/// Where the licences are inside `documentation` (FMI 2.0.1 and later, section 2.3).
pub const LICENCES_FILE: &str = "licenses/license.txt";

/// What an FMU shows and says beside its variables.
#[derive(Clone, Copy, Debug)]
pub struct Contents<'a> {
    /// The model file, or that of a linear system.
    pub model: &'a str,
    /// Where the linear system comes from; none: the file is that of a mechanism.
    pub linear: Option<&'a Origin>,
    /// The state that the model begins with; none: it begins as drawn, or at an equilibrium.
    pub state: Option<&'a [u8]>,
    /// Licences of all that is in the libraries.
    pub licences: &'a str,
    /// PNG picture that stands for the unit.
    pub icon: &'a [u8],
    /// HTML page that shows the mechanism in three dimensions, for the documentation.
    pub page: &'a str,
    /// SVG drawing: the icon of FMI 3.0, and the drawing of the documentation, which needs no WebGL.
    pub drawing: &'a str,
    /// What is in the drawing.
    pub legend: &'a str,
}
