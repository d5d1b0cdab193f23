//! Forces and moments of sections by equilibrium (MECHANICS 3.12): what the equations of the system say, on any mesh.
//! The constitutive law takes no part in them.
//!
//! Forces that the surroundings of an element supply at its nodes are in exact balance with all that acts on the rest
//! of the beam. Between the nodes, weight, inertia and loads up to the section are added to it.

use super::joint_loads::{JointLoads, Side};
use crate::math::Vec3;
use crate::math::quadrature::shares_of_three;
use crate::math::rotation::rotation_matrix;
use crate::math::vectors::add_vec3;
use crate::mechanics::beam::ancf14::coordinates::SHAPE_PLACES;
use crate::mechanics::beam::ancf14::element::Element;
use crate::mechanics::beam::ancf14::fluid_load::{Moving, Surroundings};
use crate::mechanics::beam::balance::{Acting, Balance, Instant};
use crate::mechanics::beam::element::AnyElement;
use crate::mechanics::beam::line_load::{ElementForces, LOAD_POINTS, MOST_COORDINATES};
use crate::mechanics::beam::resultants::{SectionForces, SectionStrains};
use crate::mechanics::force::load::Site;
use crate::mechanics::input::excitation::Wrench;
use crate::mechanics::marker::Marker;
use crate::mechanics::marker::configuration::Passage;
use crate::mechanics::marker::sensor::{Facing, Section};
use crate::mechanics::system::fluids::fluids_alone;
use crate::mechanics::system::inner_parts::InnerPart;

/// Force and moment of a section in its axes: of the part towards the end on the part towards the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SectionWrench {
    /// Axial force, tension positive, and shear forces along y and z, N.
    pub force: [f64; 3],
    /// Torque and moments about y and z, N m.
    pub moment: [f64; 3],
}

impl SectionWrench {
    /// All but the shear forces, of which the law of a section knows nothing.
    fn along_axis(&self) -> SectionForces {
        SectionForces { axial: self.force[0], moment: self.moment }
    }
}

/// All that acts at an instant.
#[derive(Clone, Copy, Debug)]
pub struct SectionLoads<'a> {
    /// Forces that joints, springs and actuators transmit.
    pub joints: &'a JointLoads<'a>,
    /// Second derivatives of all coordinates, 1/s² each.
    pub acceleration: &'a [f64],
}

/// An element with all that acts on it.
#[derive(Clone, Copy, Debug)]
pub struct ElementBalance<'a> {
    loads: &'a SectionLoads<'a>,
    element: usize,
    balance: Balance,
    /// Loads along the element, at their points; none: there are none.
    along: Option<[Acting; LOAD_POINTS]>,
}

impl SectionLoads<'_> {
    /// The balance of element `element`.
    pub fn of_element(&self, element: usize) -> ElementBalance<'_> {
        let JointLoads { system, state, c, passage, .. } = *self.joints;
        let own = &system.mesh.elements[element];
        let (mut inside, mut along): (ElementForces, Option<[Acting; LOAD_POINTS]>) = ([0.0; MOST_COORDINATES], None);
        for part in system.inner_parts_of(element) {
            match part {
                InnerPart::Load(number) if matches!(system.loads[number].site, Site::Line(_)) => {
                    let load = &system.loads[number];
                    let line = load.along(&load.at(state.instant(), &state.targets.loads[number]));
                    add(&own.line_force(&c.beams, &line), &mut inside);
                    let (along, extent) = (along.get_or_insert_default(), own.extent(c.beams.drives));
                    for (sum, (xi, share)) in along.iter_mut().zip(own.load_points()) {
                        let pose = own.section_pose(&c.beams, xi);
                        let [force, moment] = line.on(extent * share, &pose.axes);
                        sum.position = pose.place;
                        sum.force += force;
                        sum.moment += moment;
                    }
                }
                _ => {
                    let Some((marker, acting)) = self.at_point(part, element) else { continue };
                    let jacobian = marker.jacobian(c);
                    let force = jacobian.place_q.tr_mul(&acting.force) + jacobian.turn_q.tr_mul(&acting.moment);
                    add(force.as_slice(), &mut inside);
                }
            }
        }
        self.each_touch(element, &mut |xi, [force, moment]| {
            let jacobian = own.section_jacobian(&c.beams, xi);
            add((jacobian.place_q.tr_mul(&force) + jacobian.turn_q.tr_mul(&moment)).as_slice(), &mut inside);
        });
        system.each_bearing_on(element, c, passage, 1.0, |bearing| {
            for (weight, start) in bearing.weights.iter().zip(SHAPE_PLACES) {
                add_vec3(&mut inside, start, &(bearing.force * *weight));
            }
        });
        self.in_fluids(element, |own, water, moving| {
            own.add_fluid(water, moving, 1.0, &mut inside);
        });
        ElementBalance { loads: self, element, balance: own.balance(&c.beams, &self.instant(element), &inside), along }
    }

    /// Calls `take` with the position in element `element`, and with force (N) and moment (N m) on it in global axes,
    /// of each point that touches something.
    fn each_touch(&self, element: usize, take: &mut dyn FnMut(f64, [Vec3; 2])) {
        let JointLoads { system, c, passage, .. } = *self.joints;
        system.each_touch_of(element, c, passage, take);
        for point in self.joints.meetings_of(element) {
            take(point.xi, [point.force, Vec3::zeros()]);
        }
    }

    /// Calls `with` with element `element` in each fluid that may reach it now.
    fn in_fluids(&self, element: usize, with: impl FnMut(&Element, &Surroundings, &Moving)) {
        let JointLoads { system, state, c, .. } = *self.joints;
        if system.is_in_fluid() {
            let Instant { moves, velocity, gravity, .. } = self.instant(element);
            let water = fluids_alone(gravity, state.instant());
            let motion = moves.then_some([velocity, self.acceleration]);
            system.in_fluids(element, (c.beams.q, motion), &water, with);
        }
    }

    /// How element `element` moves.
    fn instant(&self, element: usize) -> Instant<'_> {
        let JointLoads { system, state, passage, .. } = *self.joints;
        Instant {
            moves: !matches!(passage, Passage::Rest),
            velocity: &state.velocity,
            acceleration: self.acceleration,
            strain_rates: state.known_viscous_rates(),
            gravity: system.gravity,
            mass_damping: system.beam_of(element).0.mass_damping,
        }
    }

    /// Force and moment of a part that acts between the nodes of element `element`, with its marker; none: it moves,
    /// and is on another element now.
    fn at_point(&self, part: InnerPart, element: usize) -> Option<(Marker, Acting)> {
        let JointLoads { system, state, c, .. } = *self.joints;
        let side = |is_b: bool| if is_b { Side::B } else { Side::A };
        let of_coordinate = |coordinate: usize, is_b: bool| *system.sides(coordinate)[usize::from(is_b)];
        let (marker, acting) = match part {
            InnerPart::Load(number) => {
                let load = &system.loads[number];
                let marker = load.marker(state.instant()).expect("loads along elements are spread");
                let wrench = load.at(state.instant(), &state.targets.loads[number]);
                let [force, moment] = load.in_space(&marker, c, &wrench);
                (marker, Acting { position: marker.pose(c).place, force, moment })
            }
            InnerPart::Joint(number, is_b) => {
                let joint = &system.joints[number];
                let settled = joint.settle(c)?;
                (*joint.sides(&settled)[usize::from(is_b)], self.joints.of_joint(number, side(is_b)))
            }
            InnerPart::Spring(number, is_b) => {
                let marker = of_coordinate(system.springs[number].coordinate, is_b);
                (marker, self.joints.of_spring(number, side(is_b)))
            }
            InnerPart::Actuator(number, is_b) => {
                let marker = of_coordinate(system.actuators[number].coordinate, is_b);
                (marker, self.joints.of_actuator(number, side(is_b)))
            }
            InnerPart::Rope(number, is_b) => {
                let rope = &system.ropes[number];
                let (span, seat) = if is_b { (rope.spans() - 1, rope.spans()) } else { (0, 0) };
                (rope.seats[seat].marker, self.joints.of_rope(number, span, side(is_b)))
            }
        };
        let is_here = matches!(marker, Marker::Section { element: own, .. } if own == element);
        is_here.then_some((marker, acting))
    }
}

impl ElementBalance<'_> {
    /// Force and moment of the section at `xi`, in global axes: of the part towards the end on the part towards the
    /// start. Where something acts at `xi` itself they are those of the side `facing`.
    pub fn in_space(&self, xi: f64, facing: Facing) -> Wrench {
        let JointLoads { system, c, passage, .. } = *self.loads.joints;
        if xi == 1.0 {
            let Acting { force, moment, .. } = self.balance.ends[1];
            return Wrench { force, moment };
        }
        let here = system.mesh.elements[self.element].axis_point(xi, c.beams.q);
        let mut sum = if xi == 0.0 {
            let Acting { force, moment, .. } = self.balance.ends[0];
            Wrench { force, moment }
        } else {
            self.balance.up_to(xi, &here)
        };
        if let Some(along) = &self.along {
            for (acting, share) in along.iter().zip(shares_of_three(xi)) {
                acting.add_about(&here, share, &mut sum);
            }
        }
        self.loads.each_touch(self.element, &mut |own, [force, moment]| {
            if own < xi {
                let position = system.mesh.elements[self.element].axis_point(own, c.beams.q);
                Acting { position, force, moment }.add_about(&here, 1.0, &mut sum);
            }
        });
        system.each_bearing_on(self.element, c, passage, xi, |bearing| {
            let position = system.mesh.elements[self.element].axis_point(bearing.xi, c.beams.q);
            Acting { position, force: bearing.force, moment: Vec3::zeros() }.add_about(&here, 1.0, &mut sum);
        });
        if xi > 0.0 {
            self.loads.in_fluids(self.element, |own, water, moving| {
                own.add_fluid_up_to(water, moving, xi, &here, &mut sum);
            });
        }
        for part in system.inner_parts_of(self.element) {
            if matches!(part, InnerPart::Load(number) if matches!(system.loads[number].site, Site::Line(_))) {
                continue;
            }
            let Some((marker, acting)) = self.loads.at_point(part, self.element) else { continue };
            let Marker::Section { xi: own, .. } = marker else { continue };
            if own < xi || (own == xi && facing == Facing::After) {
                acting.add_about(&here, 1.0, &mut sum);
            }
        }
        Wrench { force: -sum.force, moment: -sum.moment }
    }

    /// Force and moment of the section at `xi` in its axes, as strains have turned it.
    pub fn section(&self, xi: f64, facing: Facing) -> SectionWrench {
        let JointLoads { system, c, .. } = *self.loads.joints;
        let (element, wrench) = (&system.mesh.elements[self.element], self.in_space(xi, facing));
        let mut axes = element.section_pose(&c.beams, xi).axes;
        let turn = self.turn(element, xi);
        if turn != 0.0 {
            axes *= rotation_matrix(&(Vec3::x() * turn));
        }
        SectionWrench { force: axes.tr_mul(&wrench.force).into(), moment: axes.tr_mul(&wrench.moment).into() }
    }

    /// Strains of `section`, a section of this element: those whose elastic stress bears `forces` together with the
    /// viscous stress.
    pub fn strains(&self, section: &Section, forces: &SectionWrench) -> SectionStrains {
        let (element, by_coordinates) = self.known(section);
        let viscous = self.viscous_strains(section);
        element.strains_under(section.xi, &forces.along_axis(), [&viscous, &by_coordinates]).unwrap_or(by_coordinates)
    }

    /// Strains of `section` that make the stress of beam theory by Young's modulus, the viscous stress included.
    pub fn stress_strains(&self, section: &Section, forces: &SectionWrench) -> SectionStrains {
        let (element, by_coordinates) = self.known(section);
        element.linear_strains_under(section.xi, &forces.along_axis(), &by_coordinates).unwrap_or_else(|| {
            let viscous = self.viscous_strains(section);
            SectionStrains {
                axial: by_coordinates.axial + viscous.axial,
                curvature: [0, 1].map(|axis| by_coordinates.curvature[axis] + viscous.curvature[axis]),
                torsion: by_coordinates.torsion + viscous.torsion,
            }
        })
    }

    /// The element, and the strains of `section` by its coordinates.
    fn known(&self, section: &Section) -> (&AnyElement, SectionStrains) {
        let JointLoads { system, c, .. } = self.loads.joints;
        (&system.mesh.elements[self.element], section.strains(c))
    }

    /// Strains of `section` whose elastic stress would be the viscous one.
    fn viscous_strains(&self, section: &Section) -> SectionStrains {
        let JointLoads { system, c, .. } = *self.loads.joints;
        let element = &system.mesh.elements[self.element];
        match element.is_damped() {
            true => element.viscous_strains(&c.beams, section.xi, &self.loads.instant(self.element)),
            false => SectionStrains::default(),
        }
    }

    /// Turn of the section at `xi` by strains, beyond the pose that loads and springs hold on to, rad.
    fn turn(&self, element: &AnyElement, xi: f64) -> f64 {
        let c = &self.loads.joints.c.beams;
        if xi == 0.0 || xi == 1.0 {
            return 0.0;
        }
        element.section_turn(c, xi, &|xi| {
            let tangent = element.section_pose(c, xi).axis(0);
            tangent.dot(&self.in_space(xi, Facing::Before).moment)
        })
    }
}

fn add(own: &[f64], sum: &mut ElementForces) {
    sum.iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
}
