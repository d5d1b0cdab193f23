//! Names: which are legal, what each stands for, and which known one is nearest to a mistyped one.

use super::diagnostic::Place;
use crate::fmi::identifier::is_identifier;
use crate::model::expression::program::{FUNCTIONS, MORE_FUNCTIONS};
use std::collections::BTreeMap;

/// What a name stands for: the sections that carry names, and the entries of `[parameters]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "each is the section of its name")]
pub enum Kind {
    Parameter,
    Function,
    Material,
    Section,
    Beam,
    Body,
    Frame,
    Point,
    Joint,
    Drive,
    Winch,
    Actuator,
    Gear,
    Spring,
    Friction,
    Stop,
    Lock,
    Surface,
    Contact,
    Foundation,
    Rope,
    Load,
    Wave,
    Output,
}

/// The sections of named things, by their words in the file.
pub const SECTIONS: [(&str, Kind); 23] = [
    ("function", Kind::Function),
    ("material", Kind::Material),
    ("section", Kind::Section),
    ("body", Kind::Body),
    ("beam", Kind::Beam),
    ("frame", Kind::Frame),
    ("point", Kind::Point),
    ("joint", Kind::Joint),
    ("drive", Kind::Drive),
    ("winch", Kind::Winch),
    ("actuator", Kind::Actuator),
    ("gear", Kind::Gear),
    ("spring", Kind::Spring),
    ("friction", Kind::Friction),
    ("stop", Kind::Stop),
    ("lock", Kind::Lock),
    ("surface", Kind::Surface),
    ("contact", Kind::Contact),
    ("foundation", Kind::Foundation),
    ("rope", Kind::Rope),
    ("load", Kind::Load),
    ("wave", Kind::Wave),
    ("output", Kind::Output),
];

impl Kind {
    /// Whether it is a place: what an `a`, a `b`, an `on` or an `in` can refer to.
    pub fn is_place(self) -> bool {
        matches!(self, Self::Body | Self::Beam | Self::Frame | Self::Point)
    }

    /// Whether it holds places together or acts on them: only outputs refer to places and to these by one key.
    pub fn is_connection(self) -> bool {
        use Kind::*;
        matches!(self, Joint | Drive | Actuator | Gear | Spring | Friction | Stop | Lock | Contact | Foundation | Rope)
    }

    /// Whether the solver knows it by its name.
    pub fn is_in_system(self) -> bool {
        self.is_place() || self.is_connection() || matches!(self, Self::Winch | Self::Load)
    }

    /// Whether one name cannot stand for a thing of each of the two kinds: no reference would say which one it means.
    fn shares_names_with(self, other: Self) -> bool {
        self == other || self.is_place() && other.is_place() || self.is_connection() && other.is_connection()
    }

    /// The word for messages: `a beam`.
    pub fn word(self) -> &'static str {
        match self {
            Self::Parameter => "parameter",
            _ => SECTIONS.iter().find(|(_, kind)| *kind == self).map_or("", |(word, _)| word),
        }
    }
}

/// Names that would collide with result columns or with the sections and keys of the format.
const RESERVED: [&str; 8] = ["ground", "gravity", "simulation", "statistics", "energy", "momentum", "model", "time"];
/// The constants and variables of expressions.
const OF_EXPRESSIONS: [&str; 4] = ["t", "s", "pi", "e"];

/// The operators of expressions that are words.
const OPERATORS: [&str; 2] = ["and", "or"];

/// Whether a name is taken by the format itself; only functions and the entries of `[parameters]` stand in expressions.
pub fn is_reserved(kind: Kind, name: &str) -> bool {
    let in_expressions = || OF_EXPRESSIONS.contains(&name) || FUNCTIONS.iter().any(|(function, _)| *function == name);
    let is_called = || OPERATORS.contains(&name) || MORE_FUNCTIONS.iter().any(|(function, _)| *function == name);
    match kind {
        Kind::Function => RESERVED.contains(&name) || in_expressions() || is_called(),
        Kind::Parameter => RESERVED.contains(&name) || in_expressions(),
        _ => RESERVED.contains(&name),
    }
}

/// Letter first, then letters, digits, `_`.
pub fn is_legal(name: &str) -> bool {
    name.starts_with(|c: char| c.is_ascii_alphabetic()) && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// One named thing of the file.
#[derive(Clone, Debug, PartialEq)]
pub struct Named {
    /// Its name.
    pub name: String,
    /// What it is.
    pub kind: Kind,
    /// Its index among those of its kind, in file order.
    pub index: usize,
    /// Where the name is given.
    pub place: Place,
}

/// All names of a file.
#[derive(Clone, Debug, Default)]
pub struct Names {
    /// The named things, in the order of the file.
    list: Vec<Named>,
    /// Which of them have a name, ascending.
    by_name: BTreeMap<String, Vec<usize>>,
    /// Names that a mistake, which is reported, makes unclear: references to them are worth no message.
    pub unclear: Vec<String>,
    /// Whether things without a name are reported: an unknown name may be theirs.
    pub has_nameless: bool,
}

impl Names {
    /// The first thing whose name excludes that another thing of this kind has it.
    pub fn clash(&self, kind: Kind, name: &str) -> Option<&Named> {
        self.called(name).find(|named| named.kind.shares_names_with(kind))
    }

    /// Adds a thing, behind those that stand before it in the file.
    pub fn add(&mut self, named: Named) {
        self.by_name.entry(named.name.clone()).or_default().push(self.list.len());
        self.list.push(named);
    }

    /// The things of a name, in the order of the file.
    fn called(&self, name: &str) -> impl Iterator<Item = &Named> {
        self.by_name.get(name).into_iter().flatten().map(|number| &self.list[*number])
    }

    /// The thing of this name of a kind that `is_meant`.
    pub fn find_of(&self, name: &str, is_meant: fn(Kind) -> bool) -> Option<&Named> {
        self.called(name).find(|named| is_meant(named.kind))
    }

    /// A name that nothing has, made of one that something has and of what it is: `pin_joint`.
    pub fn free_name(&self, name: &str, kind: Kind) -> String {
        free_name(name, kind, |name| self.by_name.contains_key(name))
    }

    /// What a name stands for where one of `kinds` is expected; if it is none of them, what else it stands for.
    pub fn find_among(&self, name: &str, kinds: &[Kind]) -> Option<&Named> {
        let fitting = self.called(name).find(|named| kinds.contains(&named.kind));
        fitting.or_else(|| self.called(name).next())
    }

    /// The thing in whose section the variable `NAME.key` is written at `place`: the nearest above it.
    pub fn owner(&self, variable: &str, place: Place) -> Option<&Named> {
        let name = variable.split('.').next().unwrap_or(variable);
        self.called(name).filter(|named| named.place <= place).max_by_key(|named| named.place)
    }

    /// Whether a reported mistake is the reason that a name is not known or not what it should be.
    pub fn is_unclear(&self, name: &str) -> bool {
        self.unclear.iter().any(|unclear| unclear == name) || self.has_nameless && self.called(name).next().is_none()
    }

    /// The name of a thing by its index among its kind.
    pub fn name(&self, kind: Kind, index: usize) -> Option<&str> {
        self.list.iter().find(|named| named.kind == kind && named.index == index).map(|named| named.name.as_str())
    }

    /// The names of a kind, in file order.
    pub fn of(&self, kind: Kind) -> impl Iterator<Item = &str> {
        self.list.iter().filter(move |named| named.kind == kind).map(|named| named.name.as_str())
    }
}

/// A name that is not taken, made of one that is and of what it is: `pin_joint`.
pub fn free_name(name: &str, kind: Kind, is_taken: impl Fn(&str) -> bool) -> String {
    let mut free = format!("{name}_{}", kind.word());
    while is_taken(&free) {
        free.push('_');
    }
    free
}

/// The candidate nearest to `word`, if it is near enough to be meant: at most a third of the letters differ.
pub fn nearest<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let word: Vec<char> = word.chars().take(LONGEST).collect();
    let limit = word.len().div_ceil(3).max(1);
    let rated = candidates.into_iter().map(|candidate| (distance(&word, candidate), candidate));
    rated
        .filter(|(distance, candidate)| *distance <= limit && *distance < candidate.len())
        .min_by_key(|(d, _)| *d)
        .map(|(_, c)| c)
}

/// Letters that are compared: a name of a megabyte must not take a minute.
const LONGEST: usize = 100;

/// Letters to insert, delete, replace or swap with the neighbor to make one word of the other; case counts nothing.
fn distance(a: &[char], b: &str) -> usize {
    let lower = |c: &char| c.to_ascii_lowercase();
    let a: Vec<char> = a.iter().map(lower).collect();
    let b: Vec<char> = b.chars().take(LONGEST).map(|c| c.to_ascii_lowercase()).collect();
    let mut rows = vec![vec![0; b.len() + 1]; a.len() + 1];
    for i in 0..=a.len() {
        for j in 0..=b.len() {
            rows[i][j] = if i == 0 || j == 0 {
                i + j
            } else {
                let replaced = rows[i - 1][j - 1] + usize::from(a[i - 1] != b[j - 1]);
                let mut best = replaced.min(rows[i - 1][j] + 1).min(rows[i][j - 1] + 1);
                if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                    best = best.min(rows[i - 2][j - 2] + 1);
                }
                best
            };
        }
    }
    rows[a.len()][b.len()]
}

/// `did you mean `young`?`, or nothing.
pub fn suggestion<'a>(word: &str, candidates: impl IntoIterator<Item = &'a str>) -> String {
    nearest(word, candidates).map_or(String::new(), |name| format!("did you mean `{name}`?"))
}

/// Words of other programs and languages: where they stand, and what they are called here.
const SYNONYMS: [(&str, &[&str], &str); 35] = [
    ("type", &["fixed", "rigid", "fix", "clamp", "clamped"], "weld"),
    ("type", &["hinge", "pin", "pivot", "hinged", "pinned"], "revolute"),
    ("type", &["ball", "ball_joint", "sphere"], "spherical"),
    ("type", &["slider", "translational", "slide"], "prismatic"),
    ("type", &["cardan", "hooke"], "universal"),
    ("shape", &["h", "ibeam", "i_beam", "i-beam", "i_section"], "i"),
    ("shape", &["l", "l_section"], "angle"),
    ("shape", &["c", "u", "c_section"], "channel"),
    ("shape", &["t", "t_section"], "tee"),
    ("shape", &["hollow_rectangle", "rhs", "shs"], "box"),
    ("shape", &["round", "rod", "disk", "solid"], "circle"),
    ("shape", &["pipe", "hollow", "ring"], "tube"),
    ("shape", &["square", "rect", "strip"], "rectangle"),
    ("integrator", &["alpha", "hht", "newmark"], "generalized_alpha"),
    (KEY, &["e", "e_modulus", "youngs", "modulus"], "young"),
    (KEY, &["nu"], "poisson"),
    (KEY, &["g", "g_modulus"], "shear"),
    (KEY, &["rho"], "density"),
    (KEY, &["k"], "stiffness"),
    (KEY, &["c", "d"], "damping"),
    (KEY, &["m"], "mass"),
    (KEY, &["r"], "radius"),
    (KEY, &["torque", "thrust", "force", "moment"], "effort"),
    (KEY, &["locked", "engaged", "enabled", "released"], "active"),
    (FUNCTION, &["log"], "ln` or `log10"),
    (FUNCTION, &["loge"], "ln"),
    (FUNCTION, &["modulo", "fmod", "rem"], "mod"),
    (FUNCTION, &["heaviside"], "step"),
    (FUNCTION, &["arcsin"], "asin"),
    (FUNCTION, &["arccos"], "acos"),
    (FUNCTION, &["arctan"], "atan"),
    (FUNCTION, &["arctan2"], "atan2"),
    (FUNCTION, &["fabs", "magnitude"], "abs"),
    (FUNCTION, &["sgn", "signum"], "sign"),
    (FUNCTION, &["time"], "t"),
];

/// Where the words of expressions stand.
pub const FUNCTION: &str = "function";
/// Where the keys of sections stand.
pub const KEY: &str = "key";

/// Words that ask for what there is not, each with the place where they stand and what to do instead.
const NOT_AVAILABLE: [(&str, &[&str], &str); 1] = [(
    "shape",
    &["z", "omega", "hat", "profile", "polygon"],
    "this outline is not available; shape = \"general\" takes its area, second_moment_y, second_moment_z, product_moment and torsion_constant",
)];

/// What to do where a word asks for what there is not; none: it does not.
pub fn instead(key: &str, word: &str) -> Option<&'static str> {
    let lower = word.to_ascii_lowercase();
    let found = NOT_AVAILABLE.iter().find(|(place, words, _)| *place == key && words.contains(&lower.as_str()));
    found.map(|(.., help)| *help)
}

/// The one of `candidates` that another program calls `word`, else the nearest one; none: none is near.
pub fn meant<'a>(place: &str, word: &str, candidates: impl Iterator<Item = &'a str> + Clone) -> Option<&'a str> {
    let lower = word.to_ascii_lowercase();
    let is_meant = |candidate: &&str| {
        SYNONYMS
            .iter()
            .any(|(own, words, meant)| *own == place && meant == candidate && words.contains(&lower.as_str()))
    };
    candidates.clone().find(is_meant).or_else(|| nearest(word, candidates))
}

/// `did you mean `weld`?` for a word that another program has for it, else for the nearest candidate, or nothing.
pub fn suggestion_for<'a>(key: &str, word: &str, candidates: impl IntoIterator<Item = &'a str>) -> String {
    let lower = word.to_ascii_lowercase();
    let meant = SYNONYMS.iter().find(|(place, words, _)| *place == key && words.contains(&lower.as_str()));
    let other = || if instead(key, word).is_some() { String::new() } else { suggestion(word, candidates) };
    meant.map_or_else(other, |(.., meant)| format!("did you mean `{meant}`?"))
}

/// A C identifier made of free text, never empty and no keyword: the FMU's modelIdentifier.
pub fn identifier(text: &str) -> String {
    let mut name: String =
        text.trim().chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).take(IDENTIFIER).collect();
    if name.chars().all(|c| c == '_') {
        name = "model".to_owned();
    }
    if name.starts_with(|c: char| c.is_ascii_digit()) {
        name.insert(0, '_');
    }
    // Only a word that C or C++ keeps for itself is left to object to.
    if !is_identifier(&name) {
        name.push('_');
    }
    name
}

/// Length of an identifier: it becomes a file name.
const IDENTIFIER: usize = 60;

#[cfg(test)]
mod tests {
    use super::*;

    /// A slip of the finger finds its word; a different word finds nothing.
    #[test]
    fn nearest_names() {
        let keys = ["young", "poisson", "density", "shear"];
        assert_eq!(nearest("yuong", keys), Some("young"));
        assert_eq!(nearest("Density", keys), Some("density"));
        assert_eq!(nearest("poison", keys), Some("poisson"));
        assert_eq!(nearest("wavelength", keys), None);
        assert_eq!(nearest("x", ["y"]), None);
    }

    /// Whatever the name, C must accept the identifier.
    #[test]
    fn identifiers_are_legal_in_c() {
        for (text, expected) in [
            ("LateralBuckling", "LateralBuckling"),
            ("My beam, v2", "My_beam__v2"),
            ("4-bar", "_4_bar"),
            ("Träger", "Tr_ger"),
            ("", "model"),
            ("äöü", "model"),
            ("int", "int_"),
        ] {
            assert_eq!(identifier(text), expected);
        }
    }
}
