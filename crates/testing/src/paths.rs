//! Paths of equilibria whose exact ones are integrated: Lee's frame, arches, twisted rods.

use crate::planar_rod::{Load, Piece, Point, Rod, Support};
use crate::running::{start, value};
use crate::spatial_rod::{self, TwistedRod};
use ancf14::fmi::Model;
use ancf14::math::Vec3;
use ancf14::model::simulation::Simulation;
use std::f64::consts::PI;

const LEE: &str = include_str!("../../../models/lee_frame.toml");

/// A path, and the rod that has it.
pub struct Case {
    /// The model file.
    pub text: String,
    pub rod: Rod,
    /// Displacements of the watched place, the parameter, and what the rod begins with.
    names: [&'static str; 6],
    /// Arc length from row to row, and of the whole path.
    every: f64,
    stop: f64,
    /// The load where the parameter is 1, N or N/m.
    pub load: f64,
}

impl Case {
    /// Lee's frame; the load keeps its direction or turns with the girder.
    pub fn lee(elements: usize, follower: bool) -> Self {
        let load = "force = [0, 0, \"-4000*t\"]";
        let text = LEE.replace(load, &format!("follower = {follower}\n{load}"));
        let bending = 7.2e9 * 0.06 * 0.02_f64.powi(3) / 12.0;
        let leg = |corner: f64, length: f64| Piece { corner, length, curvature: 0.0 };
        let rod = Rod {
            bending,
            stretching: 7.2e9 * 0.06 * 0.02,
            angle: 0.5 * PI,
            supports: [Support::Hinge; 2],
            pieces: vec![leg(0.0, 1.2), leg(-0.5 * PI, 0.24), leg(0.0, 0.96)],
            load: Load::At(2),
            follower,
            // The load that Lee's frame bears is 18.5 of the critical ones of a leg.
            scales: [1.2, 18.5 * bending / 1.44],
        };
        let names = [
            "loaded_point.displacement[1]",
            "loaded_point.displacement[3]",
            "path.parameter",
            "foot.angle",
            "foot.reaction_force[1]",
            "foot.reaction_force[3]",
        ];
        let stop = if follower { 6.0 } else { 5.0 };
        // The rods bend in proportion to the moment.
        let text = text.replace("elements = 10", &format!("elements = {elements}\nstrain = \"small\""));
        Self { text, rod, names, every: 0.05, stop, load: 4000.0 }
    }

    /// An arch.
    pub fn arch(arch: &Arch, elements: usize) -> Self {
        let names = [
            "crown.displacement[1]",
            "crown.displacement[3]",
            "path.parameter",
            if arch.first == Support::Hinge { "foot_load.angle" } else { "foot_load.reaction_moment[2]" },
            "foot_load.reaction_force[1]",
            "foot_load.reaction_force[3]",
        ];
        let (text, rod) = (arch.text(elements), arch.rod());
        Self { text, rod, names, every: 0.04, stop: arch.stop, load: arch.size }
    }

    /// A half circle that is hinged at both feet, under a pressure that is `3 E I/R³` where the parameter is 1.
    pub fn half_circle(elements: usize) -> Self {
        let arch = Arch {
            half: 0.5 * PI,
            slenderness: 1e3,
            first: Support::Hinge,
            load: Load::Along(1),
            follower: true,
            size: 3.0,
            stop: 1.2,
        };
        let mut case = Self::arch(&arch, elements);
        case.text = case.text.replace("type = \"weld\"", "type = \"revolute\"\naxis = [0, 1, 0]");
        case.rod.supports = [Support::Hinge; 2];
        case
    }

    /// The equilibria of the path, and what is told of it.
    pub fn equilibria(&self) -> (Vec<Point>, Vec<String>) {
        let (rows, told) = follow(&mut start(&self.text), self.every, self.stop, &self.names);
        let point = |row: Vec<f64>| Point {
            place: [row[0], row[1]],
            load: self.load * row[2],
            start: [row[3], row[4], row[5]],
        };
        (rows.into_iter().map(point).collect(), told)
    }
}

/// Follows a path to `stop`, `every` arc length from one row to the next; returns the values of `names` in each row,
/// and what is told.
pub fn follow(simulation: &mut Simulation, every: f64, stop: f64, names: &[&str]) -> (Vec<Vec<f64>>, Vec<String>) {
    let row = |simulation: &Simulation| names.iter().map(|name| value(simulation, name)).collect();
    let (mut rows, mut told) = (vec![row(simulation)], simulation.take_warnings());
    for number in 1..=(stop / every).round() as u32 {
        simulation.advance(f64::from(number) * every).unwrap_or_else(|failure| panic!("{}", failure.message));
        rows.push(row(simulation));
        told.extend(simulation.take_warnings());
    }
    (rows, told)
}

/// The number behind `word` in the first of the sentences that has it.
pub fn number_behind(told: &[String], word: &str) -> f64 {
    let rest =
        told.iter().find_map(|sentence| sentence.split_once(word)).unwrap_or_else(|| panic!("{word}: {told:?}")).1;
    let end = rest.find(|letter: char| !"0123456789.-e".contains(letter)).unwrap_or(rest.len());
    rest[..end].parse().unwrap_or_else(|_| panic!("{rest}"))
}

/// A circular arch, the second foot of which is clamped.
pub struct Arch {
    /// Half of its angle, rad.
    pub half: f64,
    /// Radius over that of gyration of the section.
    pub slenderness: f64,
    pub first: Support,
    /// Along it; none: at its crown.
    pub load: Load,
    pub follower: bool,
    /// The load at `t = 1`, in `E I/R²` or `E I/R³`.
    pub size: f64,
    /// Where the path ends.
    pub stop: f64,
}

impl Arch {
    /// A shallow one that is clamped, and a deep one of 215 degrees that is hinged at one foot and clamped at the
    /// other, under loads at the crown and along them.
    pub fn all() -> [(&'static str, Self); 5] {
        let shallow = |follower| Self {
            half: 0.5,
            slenderness: 200.0,
            first: Support::Clamp,
            load: Load::Along(1),
            follower,
            size: 150.0,
            // Under tension, beyond the snap, shooting is too sensitive.
            stop: 1.8,
        };
        let deep = |load, follower, slenderness, size| Self {
            half: 107.5_f64.to_radians(),
            slenderness,
            first: Support::Hinge,
            load,
            follower,
            size,
            stop: 3.0,
        };
        [
            ("shallow arch, load along it", shallow(false)),
            ("shallow arch, pressure", shallow(true)),
            ("deep arch, load at the crown", deep(Load::At(1), false, 1e3, 9.0)),
            ("deep arch, load along it", deep(Load::Along(1), false, 1e3, 4.0)),
            ("deep arch, pressure", deep(Load::Along(1), true, 1e2, 4.0)),
        ]
    }

    /// A radius of 1 m and a rigidity of 1 N m²; across its plane it is far stiffer.
    pub fn text(&self, elements: usize) -> String {
        let Self { half, slenderness, first, load, follower, size, stop } = self;
        let (joint, seen) = match first {
            Support::Hinge => ("type = \"revolute\"\naxis = [0, 1, 0]", "angle"),
            Support::Clamp => ("type = \"weld\"", "reaction_moment"),
        };
        let place = if *load == Load::At(1) { "at = \"arch@0.5\"" } else { "on = \"arch\"" };
        // Follower loads are along the axes of the section: z is across the arch, to the left of its tangent.
        format!(
            "format = 1\n[model]\nname = \"Arch\"\ngravity = [0, 0, 0]\n\
             [section.strip]\nshape = \"rigidities\"\nEA = {:e}\nEI_y = 1\nEI_z = 1e3\nGJ = 1e3\nline_density = 1\n\
             [beam.arch]\nsection = \"strip\"\nelements = {elements}\nstrain = \"small\"\ny_axis = [0, 1, 0]\n\
             curve = {{ x = \"sin(s)\", y = 0, z = \"cos(s)\", s = [{:e}, {half:e}] }}\n\
             [joint.foot]\n{joint}\na = \"ground\"\nb = \"arch.start\"\n\
             [joint.heel]\ntype = \"weld\"\na = \"ground\"\nb = \"arch.end\"\n\
             [load.weight]\n{place}\nforce = [0, 0, \"-{size}*t\"]\nfollower = {follower}\n\
             [output.crown]\nat = \"arch@0.5\"\nquantities = [\"displacement\"]\n\
             [output.foot_load]\nat = \"foot\"\nquantities = [\"reaction_force\", \"{seen}\"]\n\
             [simulation]\nanalysis = \"static\"\nfollow = \"arc_length\"\nstop = {stop}\nstep = 0.02\n",
            slenderness * slenderness,
            -half,
        )
    }

    fn rod(&self) -> Rod {
        let piece = || Piece { corner: 0.0, length: self.half, curvature: -1.0 };
        Rod {
            bending: 1.0,
            stretching: self.slenderness * self.slenderness,
            angle: self.half,
            supports: [self.first, Support::Clamp],
            pieces: vec![piece(), piece()],
            load: self.load,
            follower: self.follower,
            scales: [1.0, self.size],
        }
    }
}

/// A round rod that is straight without stress, clamped at its start; its end slides along its axis, or closes a ring,
/// and is turned by `10 t` rad.
pub struct Twisted {
    pub text: String,
    pub rod: TwistedRod,
    stop: f64,
}

impl Twisted {
    /// A length of 1 m and rigidities of 1 and 0.75 N m²; the path goes over to the buckled one. Of the equilibria that
    /// are alike but for a turn about the axis, or for a shift along the ring, `level` and `even` choose one: they
    /// exert no force.
    pub fn new(elements: usize, is_ring: bool) -> Self {
        let (line, grip, even, end, stop) = if is_ring {
            let line = "curve = { x = \"sin(2*pi*s)/(2*pi)\", y = \"(1 - cos(2*pi*s))/(2*pi)\", z = 0, s = [0, 1] }\nfree_curvature = [0, 0]";
            let even = "[joint.even]\ntype = \"inplane\"\na = \"ground\"\nb = \"rod@0.25\"\naxis = [0, 0, 1]\n";
            (line, "type = \"weld\"", even, 0, 14.0)
        } else {
            ("from = [0, 0, 0]\nto = [1, 0, 0]", "type = \"prismatic\"\naxis = [1, 0, 0]", "", 1, 15.0)
        };
        let text = format!(
            "format = 1\n[model]\nname = \"Twisted\"\ngravity = [0, 0, 0]\n\
             [section.wire]\nshape = \"rigidities\"\nEA = 1e6\nEI_y = 1\nEI_z = 1\nGJ = 0.75\nline_density = 1\n\
             [beam.rod]\nsection = \"wire\"\nelements = {elements}\nstrain = \"small\"\ny_axis = [0, 1, 0]\n{line}\n\
             [frame.hand]\nposition = [{end}, 0, 0]\nrotation = [\"10*t\", 0, 0]\n\
             [joint.root]\ntype = \"weld\"\na = \"ground\"\nb = \"rod.start\"\n\
             [joint.grip]\n{grip}\na = \"hand\"\nb = \"rod.end\"\n\
             [joint.level]\ntype = \"inplane\"\na = \"ground\"\nb = \"rod@0.5\"\naxis = [0, 0, 1]\n{even}\
             [output.middle]\nat = \"rod@0.5\"\nquantities = [\"displacement\"]\n\
             [output.root_load]\nat = \"root\"\nquantities = [\"reaction_force\", \"reaction_moment\"]\n\
             [simulation]\nanalysis = \"static\"\nfollow = \"arc_length\"\nbranches = [1]\nstop = {stop}\nstep = 0.1\n"
        );
        let middle = if is_ring { Vec3::new(0.0, 1.0 / PI, 0.0) } else { Vec3::new(0.5, 0.0, 0.0) };
        let rod = TwistedRod { bending: 1.0, torsion: 0.75, stretching: 1e6, length: 1.0, is_ring, middle };
        Self { text, rod, stop }
    }

    /// The equilibria of the path, and what is told of it.
    pub fn equilibria(&self) -> (Vec<spatial_rod::Point>, Vec<String>) {
        let vectors = ["middle.displacement", "root_load.reaction_force", "root_load.reaction_moment"];
        let names = vectors.iter().flat_map(|name| (1..=3).map(move |axis| format!("{name}[{axis}]")));
        let names: Vec<String> = names.chain([String::from("path.parameter")]).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let (rows, told) = follow(&mut start(&self.text), 0.1, self.stop, &names);
        let point = |row: Vec<f64>| {
            let part = |first: usize| Vec3::new(row[first], row[first + 1], row[first + 2]);
            spatial_rod::Point { middle: part(0), turn: 10.0 * row[9], start: [part(3), part(6)] }
        };
        (rows.into_iter().map(point).collect(), told)
    }
}
