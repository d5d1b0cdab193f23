//! A machine in a random state, and its markers and measures written a second time over any dual number: the oracle for
//! the derivatives of joints, drives, springs and loads. A dropped term shows at 1e-2 or more; the bound is rounding.

use crate::elements::ancf24_oracle;
use crate::elements::element_derivatives::{random_element_state, stiffness, straight};
use crate::random::Random;
use crate::support::oracle::{self, Scalar};
use ancf14::math::jet::Jet;
use ancf14::math::{Mat3, Vec3};
use ancf14::mechanics::beam::ancf14::coordinates::NODE;
use ancf14::mechanics::beam::ancf14::element::{Element, Place};
use ancf14::mechanics::beam::ancf14::frame::NodeFrame;
use ancf14::mechanics::beam::ancf14::strain::Strain;
use ancf14::mechanics::beam::ancf24;
use ancf14::mechanics::beam::configuration::BeamConfiguration;
use ancf14::mechanics::beam::element::AnyElement;
use ancf14::mechanics::beam::mesh::Mesh;
use ancf14::mechanics::beam::node::Node;
use ancf14::mechanics::geometry::marker_jacobian::MarkerMatrix;
use ancf14::mechanics::geometry::pose::Pose;
use ancf14::mechanics::geometry::triad::Triad;
use ancf14::mechanics::input::prescribed::{MovingPose, Prescribed};
use ancf14::mechanics::marker::Marker;
use ancf14::mechanics::marker::configuration::Configuration;
use ancf14::mechanics::marker::relative_coordinate::Measure;
use nalgebra::{SMatrix, SVector};
use num_dual::Dual2SVec64;

pub const ROUNDING: f64 = 1e-9;
/// Coordinates: two elements of ANCF14, one of ANCF24, a body.
pub const COUNT: usize = 64;
/// Where those of ANCF24 start.
const SECTIONS: usize = 28;
/// Where the body's start.
pub const BODY: usize = 52;
/// Coordinates, and time as the last one.
pub const ALL: usize = COUNT + 1;
pub type All<D> = SVector<D, ALL>;
pub type Dual = Dual2SVec64<ALL>;

/// Two elements of two beams (nodes 0, 1 and 2, 3), one of ANCF24 (nodes 4, 5) with sheared and stretched sections, a
/// body whose directors are not orthonormal, a moving frame and a drive, in a random state.
pub struct Machine {
    pub mesh: Mesh,
    pub q: SVector<f64, COUNT>,
    pub velocity: SVector<f64, COUNT>,
    pub triads: [Triad; 4],
    pub holonomy: [f64; 2],
    pub frames: [NodeFrame; 4],
    pub prescribed: Prescribed,
}

impl Machine {
    pub fn new(random: &mut Random) -> Self {
        let mut q = SVector::<f64, COUNT>::zeros();
        let mut triads = [Triad { t: Vec3::x(), u: Vec3::y() }; 4];
        let mut holonomy = [0.0; 2];
        for beam in 0..2 {
            let (own, own_triads, previous) = random_element_state(random, 0.7, 0.8, 1.0);
            q.fixed_rows_mut::<14>(14 * beam).copy_from(&own);
            triads[2 * beam..2 * beam + 2].copy_from_slice(&own_triads);
            holonomy[beam] = previous;
        }
        q.fixed_rows_mut::<24>(SECTIONS).copy_from(&ancf24_oracle::deformed(random, 0.4));
        let directors = random.rotation() + Mat3::from_fn(|_, _| 0.1 * random.signed());
        q.fixed_rows_mut::<3>(BODY).copy_from(&random.vector());
        q.fixed_rows_mut::<9>(BODY + 3).copy_from_slice(directors.as_slice());
        let frames =
            std::array::from_fn(|node| NodeFrame::new(&q.as_slice()[NODE * node..NODE * (node + 1)], &triads[node]));
        let first = straight(0.7, stiffness(Strain::Small));
        let second = Element { place: Place { start: 14, frame: 2, branch: 1 }, ..first.clone() };
        let third = ancf24_oracle::element(ancf24_oracle::LAWS[0], &ancf24_oracle::straight());
        let third = ancf24::element::Element { start: SECTIONS, ..third };
        let framed = (0..4).map(|frame| Node::Ancf14 { start: NODE * frame, frame });
        let unframed = (0..2).map(|node| Node::Ancf24 { start: SECTIONS + ancf24::coordinates::NODE * node });
        let nodes = framed.chain(unframed).collect();
        let elements = vec![AnyElement::Ancf14(first), AnyElement::Ancf14(second), AnyElement::Ancf24(Box::new(third))];
        let mesh = Mesh { nodes, elements, framed: (0..4).map(|frame| NODE * frame).collect(), branches: 2 };
        let mut any = || Pose { place: random.vector(), axes: Mat3::from_fn(|_, _| random.signed()) };
        let (velocity, acceleration) = (any(), any());
        let pose = Pose { place: random.vector(), axes: random.rotation() };
        let frame = MovingPose { pose, velocity, acceleration };
        let drive = Jet { value: random.signed(), first: random.signed(), second: random.signed() };
        let prescribed = Prescribed { drives: vec![drive], frames: vec![frame], ..Prescribed::default() };
        let velocity = SVector::from_fn(|_, _| random.signed());
        Self { mesh, q, velocity, triads, holonomy, frames, prescribed }
    }

    pub fn configuration(&self) -> Configuration<'_> {
        Configuration {
            beams: BeamConfiguration {
                q: self.q.as_slice(),
                frames: &self.frames,
                holonomy: &self.holonomy,
                heats: &[],
                drives: &[],
            },
            relative_values: &[0.0],
            accepted: (self.q.as_slice(), &self.prescribed),
            memory: &[],
            prescribed: &self.prescribed,
            mesh: &self.mesh,
        }
    }

    /// Coordinates, and time 0.
    pub fn all(&self) -> All<f64> {
        All::from_fn(|index, _| if index < COUNT { self.q[index] } else { 0.0 })
    }

    /// What the drive prescribes at the time `q[COUNT]`.
    pub fn driven<D: Scalar>(&self, q: &[D]) -> D {
        let (jet, t) = (&self.prescribed.drives[0], q[COUNT]);
        t * t * (0.5 * jet.second) + t * jet.first + jet.value
    }

    /// Place and the three axes of a marker, over any dual number.
    pub fn pose<D: Scalar>(&self, marker: &Marker, q: &[D]) -> [[D; 3]; 4] {
        let combine = |columns: &[[D; 3]; 3], local: &Vec3| {
            let mut sum = [D::from(0.0); 3];
            for (column, factor) in columns.iter().zip(local) {
                sum = oracle::sum(&sum, &oracle::scale(column, D::from(*factor)));
            }
            sum
        };
        let tied = |place: [D; 3], columns: [[D; 3]; 3], offset: &Vec3, axes: &Mat3| {
            let axis = |i: usize| combine(&columns, &axes.column(i).into_owned());
            [oracle::sum(&place, &combine(&columns, offset)), axis(0), axis(1), axis(2)]
        };
        match marker {
            Marker::Ground(pose) => {
                let axis = |i: usize| oracle::constant(&pose.axes.column(i).into_owned());
                [oracle::constant(&pose.place), axis(0), axis(1), axis(2)]
            }
            Marker::Frame { frame, offset, axes } => {
                let motion = &self.prescribed.frames[*frame];
                let t = q[COUNT];
                let at = |select: &dyn Fn(&Pose) -> Vec3| {
                    let [value, first, second] = [&motion.pose, &motion.velocity, &motion.acceleration]
                        .map(|pose| oracle::constant(&select(pose)));
                    let linear = oracle::sum(&value, &oracle::scale(&first, t));
                    oracle::sum(&linear, &oracle::scale(&second, t * t * 0.5))
                };
                let columns = [0, 1, 2].map(|i| at(&|pose: &Pose| pose.axis(i)));
                tied(at(&|pose: &Pose| pose.place), columns, offset, axes)
            }
            Marker::Body { start, offset, axes } => {
                let part = |place: usize| std::array::from_fn(|i| q[start + place + i]);
                tied(part(0), [part(3), part(6), part(9)], offset, axes)
            }
            Marker::Node { node, offset, axes } => {
                let (place, columns) = match self.mesh.nodes[*node] {
                    Node::Ancf14 { start, frame } => {
                        let frame = oracle::node(&q[start..start + NODE], &self.triads[frame]);
                        (start, [frame.t, frame.y, frame.z])
                    }
                    Node::Ancf24 { start } => {
                        (start, ancf24_oracle::axes(&vector(q, start + 6), &vector(q, start + 9)))
                    }
                };
                tied(vector(q, place), columns, offset, axes)
            }
            Marker::Section { element, xi, offset, axes } => match &self.mesh.elements[*element] {
                AnyElement::PaidOut(_) => panic!("the oracle knows no winches"),
                AnyElement::Ancf14(part) => {
                    let own = &q[part.place.start..part.place.start + 14];
                    let triads = [self.triads[part.place.frame], self.triads[part.place.frame + 1]];
                    let (t, y, _) = oracle::inside(part, own, D::from(0.0), &triads, self.holonomy[*element], *xi);
                    let place = interpolated(own, [0, 3, 7, 10], &ancf14::math::hermite::shape(*xi, part.length));
                    tied(place, [t, y, oracle::cross(&t, &y)], offset, axes)
                }
                AnyElement::Ancf24(part) => {
                    let own = &q[part.start..part.start + 24];
                    let axis = interpolated(own, [0, 3, 12, 15], &ancf14::math::hermite::shape(*xi, part.length));
                    let linear =
                        |first: usize| interpolated(own, [first, first + 12, 0, 0], &[1.0 - xi, *xi, 0.0, 0.0]);
                    let [t, y, z] = ancf24_oracle::axes(&linear(6), &linear(9));
                    tied(axis, [t, y, z], offset, axes)
                }
            },
        }
    }
}

fn vector<D: Scalar>(q: &[D], place: usize) -> [D; 3] {
    std::array::from_fn(|i| q[place + i])
}

/// The sum of the vectors that start at `places` with these weights.
fn interpolated<D: Scalar>(q: &[D], places: [usize; 4], weights: &[f64; 4]) -> [D; 3] {
    std::array::from_fn(|i| {
        q[places[0] + i] * weights[0]
            + q[places[1] + i] * weights[1]
            + q[places[2] + i] * weights[2]
            + q[places[3] + i] * weights[3]
    })
}

/// Runs a test with room for arrays of dual numbers on its stack: one with its Hessian takes 35 kB.
pub fn deep(test: fn()) {
    std::thread::Builder::new().stack_size(1 << 28).spawn(test).unwrap().join().unwrap();
}

/// Everything a joint may hold on to, by number.
pub fn any_marker(random: &mut Random, kind: usize) -> Marker {
    let (offset, axes) = (random.vector(), random.rotation());
    match kind {
        0 => Marker::Ground(Pose { place: offset, axes }),
        1 => Marker::Node { node: 1, offset, axes },
        2 => Marker::Node { node: 2, offset, axes },
        3 => Marker::Body { start: BODY, offset, axes },
        4 => Marker::Frame { frame: 0, offset, axes },
        5 => Marker::Node { node: 4, offset, axes },
        6 => Marker::Node { node: 5, offset, axes },
        7 => Marker::section(2, 0.5 + 0.49 * random.signed()),
        // An arm on a section inside an element: of ANCF14, of ANCF24.
        8 => Marker::Section { element: 1, xi: 0.5 + 0.49 * random.signed(), offset, axes },
        _ => Marker::Section { element: 2, xi: 0.5 + 0.49 * random.signed(), offset, axes },
    }
}

/// Pairs of kinds that may be joined; the last ones are of ANCF24, and sections inside elements, bare and with an arm,
/// which springs hold on to.
pub const SIDES: [[usize; 2]; 16] = [
    [0, 2],
    [1, 2],
    [3, 2],
    [4, 2],
    [0, 3],
    [1, 3],
    [4, 3],
    [2, 4],
    [3, 0],
    [5, 2],
    [3, 5],
    [6, 5],
    [7, 1],
    [8, 1],
    [3, 8],
    [9, 3],
];

/// A measure over any dual number, straight from its definition.
pub fn measure<D: Scalar>(kind: Measure, a: &[[D; 3]; 4], b: &[[D; 3]; 4]) -> D {
    let apart = oracle::sum(&b[0], &oracle::scale(&a[0], D::from(-1.0)));
    match kind {
        Measure::Distance(axis) => oracle::dot(&a[1 + axis], &apart),
        Measure::Length => oracle::dot(&apart, &apart).sqrt(),
        Measure::Angle(axis) => {
            // The mean direction of both normals of b in the plane of a: the angle of the nearest rotation.
            let [j, k] = [1 + (axis + 1) % 3, 1 + (axis + 2) % 3];
            let sine = oracle::dot(&a[k], &b[j]) - oracle::dot(&a[j], &b[k]);
            sine.atan2(oracle::dot(&a[j], &b[j]) + oracle::dot(&a[k], &b[k]))
        }
        Measure::Rotation(component) => {
            let [j, k] = [1 + (component + 1) % 3, 1 + (component + 2) % 3];
            let trace = oracle::dot(&a[1], &b[1]) + oracle::dot(&a[2], &b[2]) + oracle::dot(&a[3], &b[3]);
            let cosine = (trace - 1.0) * 0.5;
            let part = (oracle::dot(&a[k], &b[j]) - oracle::dot(&a[j], &b[k])) * 0.5;
            part * cosine.acos() / (-(cosine * cosine) + 1.0).sqrt()
        }
    }
}

/// Blocks `aa, ab, ba, bb` in their places.
pub fn spread(machine: &Machine, sides: [&Marker; 2], blocks: &[MarkerMatrix; 4]) -> SMatrix<f64, COUNT, COUNT> {
    let ranges = sides.map(|marker| marker.coordinates(&machine.mesh));
    let mut sum = SMatrix::zeros();
    for (place, block) in blocks.iter().enumerate() {
        for (i, row) in ranges[place / 2].clone().enumerate() {
            for (j, column) in ranges[place % 2].clone().enumerate() {
                sum[(row, column)] += block[(i, j)];
            }
        }
    }
    sum
}
