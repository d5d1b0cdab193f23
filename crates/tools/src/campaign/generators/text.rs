//! The text of a model file, part by part.

use std::fmt::Write;

/// Steps after which a table has a row, at least: coarse steps then fall on rows.
const ROW: usize = 5;
/// Rows of a table, about.
const ROWS: usize = 120;

/// A model file that is being written.
pub struct Text(String);

/// A number as an engineer writes it.
pub fn number(value: f64) -> String {
    // A sum of three-digit numbers is not one, but its last bits are nobody's.
    let value: f64 = format!("{value:.9e}").parse().expect("a number that was printed");
    if value != 0.0 && !(1e-3..1e5).contains(&value.abs()) { format!("{value:e}") } else { format!("{value}") }
}

/// `[1, 2, 3]`.
pub fn list<const N: usize>(values: [f64; N]) -> String {
    format!("[{}]", values.map(number).join(", "))
}

impl Text {
    /// A machine under gravity along -z, m/s².
    pub fn new(gravity: f64) -> Self {
        Self(format!("format = 1\n\n[model]\nname = \"Campaign\"\ngravity = {}\n", list([0.0, 0.0, 0.0 - gravity])))
    }

    /// A section of the file.
    pub fn add(&mut self, header: &str, entries: &str) {
        // Writing into a String cannot fail.
        let _ = write!(self.0, "\n[{header}]\n{}\n", entries.trim_end());
    }

    /// The material `matter`: Young's modulus, Pa; density, kg/m³; damping, s.
    pub fn matter(&mut self, young: f64, density: f64, damping: f64) {
        self.material("matter", young, density, damping);
    }

    /// A material.
    pub fn material(&mut self, name: &str, young: f64, density: f64, damping: f64) {
        let damping = if damping > 0.0 { format!("damping = {}\n", number(damping)) } else { String::new() };
        let entries = format!("young = {}\npoisson = 0.3\ndensity = {}\n{damping}", number(young), number(density));
        self.add(&format!("material.{name}"), &entries);
    }

    /// Steel, without damping.
    pub fn steel(&mut self) {
        self.matter(2.1e11, 7850.0, 0.0);
    }

    /// A rectangular section, m.
    pub fn rectangle(&mut self, name: &str, width: f64, height: f64) {
        let entries = format!("shape = \"rectangle\"\nwidth = {}\nheight = {}", number(width), number(height));
        self.add(&format!("section.{name}"), &entries);
    }

    /// A round section, m.
    pub fn circle(&mut self, name: &str, radius: f64) {
        self.add(&format!("section.{name}"), &format!("shape = \"circle\"\nradius = {}", number(radius)));
    }

    /// A straight beam of `matter`.
    pub fn beam(&mut self, name: &str, section: &str, ends: [[f64; 3]; 2], elements: usize, more: &str) {
        let [from, to] = ends.map(list);
        self.line(name, section, elements, &format!("from = {from}\nto = {to}\n{more}"));
    }

    /// A beam of `matter` along a line.
    pub fn line(&mut self, name: &str, section: &str, elements: usize, line: &str) {
        let entries =
            format!("material = \"matter\"\nsection = \"{section}\"\n{}\nelements = {elements}", line.trim_end());
        self.add(&format!("beam.{name}"), &entries);
    }

    /// A body: mass, kg; place, m; moments of inertia, kg m².
    pub fn body(&mut self, name: &str, mass: f64, position: [f64; 3], inertia: [f64; 3], more: &str) {
        let (position, inertia) = (list(position), list(inertia));
        let entries = format!("mass = {}\nposition = {position}\ninertia = {inertia}\n{more}", number(mass));
        self.add(&format!("body.{name}"), &entries);
    }

    /// A joint between a and b.
    pub fn joint(&mut self, name: &str, kind: &str, sides: [&str; 2], more: &str) {
        let [a, b] = sides;
        self.add(&format!("joint.{name}"), &format!("type = \"{kind}\"\na = \"{a}\"\nb = \"{b}\"\n{more}"));
    }

    /// A drive of a joint's coordinate.
    pub fn drive(&mut self, name: &str, joint: &str, coordinate: &str, law: &str) {
        self.add(&format!("drive.{name}"), &format!("joint = \"{joint}\"\ncoordinate = \"{coordinate}\"\n{law}"));
    }

    /// A load at a point.
    pub fn load(&mut self, name: &str, at: &str, what: &str) {
        self.add(&format!("load.{name}"), &format!("at = \"{at}\"\n{what}"));
    }

    /// A spring: stiffness, N/m; damping, N s/m.
    pub fn spring(&mut self, name: &str, sides: [&str; 2], [stiffness, damping]: [f64; 2], more: &str) {
        let [a, b] = sides;
        let (stiffness, damping) = (number(stiffness), number(damping));
        let entries = format!("a = \"{a}\"\nb = \"{b}\"\nstiffness = {stiffness}\ndamping = {damping}\n{more}");
        self.add(&format!("spring.{name}"), &entries);
    }

    /// An output.
    pub fn watch(&mut self, name: &str, at: &str, quantities: &[&str]) {
        let quantities: Vec<String> = quantities.iter().map(|quantity| format!("\"{quantity}\"")).collect();
        self.add(&format!("output.{name}"), &format!("at = \"{at}\"\nquantities = [{}]", quantities.join(", ")));
    }

    /// Place and velocity of a point or body.
    pub fn watch_motion(&mut self, name: &str, at: &str) {
        self.watch(name, at, &["position", "velocity"]);
    }

    /// The end of the file: so many steps of a size, s, from `start`, s.
    pub fn end_from(mut self, start: f64, step: f64, steps: usize, more: &str) -> String {
        let row = ROW * steps.div_ceil(ROW * ROWS);
        let steps = steps.div_ceil(row) * row;
        let span = number(step * steps as f64);
        // Far from 0 the time takes all the digits there are.
        let stop = if start == 0.0 { span } else { format!("{}", start + step * steps as f64) };
        let (step, row) = (number(step), number(step * row as f64));
        self.add("simulation", &format!("stop = {stop}\nstep = {step}\noutput_step = {row}\n{more}"));
        self.0
    }

    /// The same from t = 0.
    pub fn end(self, step: f64, steps: usize, more: &str) -> String {
        self.end_from(0.0, step, steps, more)
    }

    /// The end of a static file: from t = 0 to 1 s in so many increments.
    pub fn end_static(self, increments: usize) -> String {
        // A row an increment.
        let mut text = self;
        let step = number(1.0 / increments as f64);
        text.add("simulation", &format!("analysis = \"static\"\nstop = 1\nstep = {step}\noutput_step = {step}"));
        text.0
    }
}
