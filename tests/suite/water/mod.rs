//! Beams in water: buoyancy, drag, added mass, the surface.

mod added_mass;
mod air;
mod bodies;
mod drag;
mod lay;
mod riser;
mod seabed;
mod surface;
mod told_errors;
mod waves;

/// A model file with water of `density` kg/m³, whose surface is at `surface` m, and with gravity `gravity` m/s²; `rest`
/// are more keys of `[water]`.
fn water(gravity: f64, density: f64, surface: f64, rest: &str) -> String {
    format!(
        "format = 1\n[model]\nname = \"Water\"\ngravity = [0, 0, {}]\n\
         [water]\ndensity = {density}\nsurface = {surface}\n{rest}\n",
        -gravity
    )
}

/// A section `round` of rigidities: `[EA, EI]`, mass per length and diameter; `rest` are more keys.
fn section([axial, bending]: [f64; 2], line_density: f64, diameter: f64, rest: &str) -> String {
    format!(
        "[section.round]\nshape = \"rigidities\"\nEA = {axial}\nEI_y = {bending}\nEI_z = {bending}\nGJ = {bending}\n\
         line_density = {line_density}\nouter_diameter = {diameter}\n{rest}\n"
    )
}
