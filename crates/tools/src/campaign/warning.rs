//! Which warnings tell that numbers are not to be trusted, by words that are in them.

/// What is doubted by a warning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Doubt {
    /// The steps do not resolve the motion.
    Steps,
    /// A part of the results, or what they mean.
    Results,
    /// Nothing: it is about the file.
    Nothing,
}

/// Words of every warning that is known, with what is doubted by it.
const KNOWN: [(&str, Doubt); 32] = [
    ("the integrator has gained", Doubt::Steps),
    ("the integrator has lost", Doubt::Steps),
    ("numerical damping has taken", Doubt::Steps),
    ("because of the length of the steps", Doubt::Results),
    ("the forces of joints, which grow without end", Doubt::Steps),
    ("steps were rejected", Doubt::Results),
    ("stops what it holds within", Doubt::Results),
    ("which no finite force can do", Doubt::Results),
    ("elements spread a jump", Doubt::Results),
    ("the mesh is too coarse", Doubt::Results),
    ("the law of strain = \"large\"", Doubt::Nothing),
    ("because of the mesh, as estimated", Doubt::Results),
    ("the mesh error is not known", Doubt::Results),
    ("found far from where the mechanism is drawn", Doubt::Results),
    ("alternates from step to step", Doubt::Results),
    ("its torsion softens and fails", Doubt::Results),
    ("finer than beam theory", Doubt::Results),
    ("jumps to another branch", Doubt::Results),
    ("becomes unstable", Doubt::Results),
    ("becomes stable again", Doubt::Results),
    ("is unstable: what would leave it", Doubt::Results),
    ("unstable mode", Doubt::Results),
    ("initial velocities", Doubt::Nothing),
    ("takes no load and costs no energy", Doubt::Nothing),
    ("take no load and cost no energy", Doubt::Nothing),
    ("the quaternion of frame", Doubt::Nothing),
    ("is unusually soft", Doubt::Nothing),
    ("is unusually light", Doubt::Nothing),
    ("Angles are in radians", Doubt::Nothing),
    ("begins with a jump of velocity", Doubt::Nothing),
    ("shear deformation matters", Doubt::Nothing),
    ("grows without bound", Doubt::Results),
];

/// What is doubted by a warning; one that is not known here counts as a doubt of the results, and the page names it.
fn doubt(warning: &str) -> Option<Doubt> {
    KNOWN.iter().find(|(words, _)| warning.contains(words)).map(|(_, doubt)| *doubt)
}

/// The first warning that tells that numbers are not to be trusted.
pub fn doubt_of_numbers(warnings: &[String]) -> Option<&String> {
    warnings.iter().find(|warning| doubt(warning) != Some(Doubt::Nothing))
}

/// Whether one of the warnings tells that the steps do not resolve the motion.
pub fn doubts_the_steps(warnings: &[String]) -> bool {
    warnings.iter().any(|warning| doubt(warning) == Some(Doubt::Steps))
}

/// The first warning that is not known here.
pub fn unknown(warnings: &[String]) -> Option<&String> {
    warnings.iter().find(|warning| doubt(warning).is_none())
}

/// The words of the warnings that count.
pub fn counted() -> impl Iterator<Item = &'static str> {
    KNOWN.iter().filter(|(_, doubt)| *doubt != Doubt::Nothing).map(|(words, _)| *words)
}
