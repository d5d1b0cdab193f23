//! Reports what water and air cannot act on, and what they need to know.

use super::Checker;
use crate::mechanics::beam::design::Elements;
use crate::model::file::document::Document;
use crate::model::file::entries::beam::BeamSpec;
use crate::model::file::entries::body::BodySpec;
use crate::model::file::entries::section::SectionSpec;
use crate::model::file::entries::simulation::{Analysis, IntegratorSpec};
use crate::model::file::entries::water::WaterSpec;
use crate::model::file::number::Number;
use crate::model::file::quantity::Quantity;
use crate::model::shape::sections::outer_diameter;
use crate::model::text::diagnostic::Place;

/// How to make a model wet.
const ADD_WATER: &str = "add [water] with its density: 1025 kg/m3 for sea water";
/// How to make a model wet, or windy.
const ADD_FLUID: &str = "add [water] with its density, or [air] with its wind";
/// How to keep fluids off a beam.
const KEEP_OFF: &str = "outer_diameter = 0 in its section keeps it off the beam";

impl Checker<'_> {
    /// Reports the mistakes around `[water]` and `[air]`.
    pub(super) fn check_fluids(&mut self) {
        let document = self.document;
        for section in &document.sections {
            self.check_drag_area(section);
        }
        document.bodies.iter().for_each(|body| self.check_volume(body));
        if let Some(water) = &document.water {
            self.check_fluid("water", water.place);
        }
        if let Some(air) = &document.air {
            self.check_fluid("air", air.place);
        }
        let Some(water) = &document.water else {
            self.check_dry();
            return;
        };
        self.check_gravity(water);
        if let Some(wave) = document.waves.first()
            && document.value(document.model.gravity[2]) == 0.0
        {
            let message = format!("wave {} is in a model without gravity", wave.name);
            self.mistake(wave.place, &message, "waves are driven by it", "set gravity = [0, 0, -9.81] in [model]");
        }
        if water.depth.is_none() {
            self.refuse_outputs(|own| own == Quantity::Clearance, "its water has no bottom", "give `depth` in [water]");
        }
        self.check_seabed();
    }

    /// Reports what `fluid`, whose section stands at `section`, cannot act on.
    fn check_fluid(&mut self, fluid: &str, section: Place) {
        let document = self.document;
        if document.simulation.analysis == Analysis::Dynamic
            && matches!(document.simulation.integrator, IntegratorSpec::GeneralizedAlpha { .. })
        {
            let message = format!("generalized_alpha does not support {fluid}");
            let label = format!("a model with [{fluid}] needs another integrator");
            let help = format!("leave integrator out: the default supports {fluid}");
            self.mistake(section, &message, &label, &help);
        }
        let reached = document.beams.iter().filter(|beam| fluid == "water" || meets_air(document, beam));
        reached.for_each(|beam| self.check_beam_in(fluid, beam));
    }

    /// Reports outputs of lines on a seabed that is not there.
    fn check_seabed(&mut self) {
        if self.document.contacts.iter().all(|contact| contact.bed.is_none()) {
            let help = "add [seabed] with its `stiffness`, and `depth` in [water]";
            self.refuse_outputs(Quantity::is_of_seabed, "the model has no seabed", help);
        }
    }

    /// Reports outputs with a quantity of which `is_meant` says so.
    fn refuse_outputs(&mut self, is_meant: impl Fn(Quantity) -> bool, reason: &str, help: &str) {
        let document = self.document;
        for output in &document.outputs {
            if let Some(quantity) = output.quantities.iter().find(|own| is_meant(**own)) {
                let word = quantity.row().word;
                let message = format!("output {} measures \"{word}\", and {reason}", output.name);
                self.mistake(output.place, &message, "this is not known", help);
            }
        }
    }

    /// Reports what only a model with water has.
    fn check_dry(&mut self) {
        let document = self.document;
        for wave in &document.waves {
            let message = format!("wave {} has no water", wave.name);
            self.mistake(wave.place, &message, "a section [water] is missing", ADD_WATER);
        }
        for output in &document.outputs {
            let is_missed = |own: &&Quantity| own.is_of_water() || own.is_of_flow() && document.air.is_none();
            if let Some(quantity) = output.quantities.iter().find(is_missed) {
                let word = quantity.row().word;
                let message = format!("output {} measures \"{word}\", and the model has no water", output.name);
                let help = if quantity.is_of_flow() { ADD_FLUID } else { ADD_WATER };
                self.mistake(output.place, &message, "a section [water] is missing", help);
            }
        }
        self.check_seabed();
    }

    /// Water acts on the volume of a body.
    fn check_volume(&mut self, body: &BodySpec) {
        let document = self.document;
        let volume = document.value(body.volume);
        let written = [("drag_areas", body.drag_areas), ("added_mass", body.added_mass)];
        if let Some((key, numbers)) = written.into_iter().find_map(|(key, own)| Some((key, own?)))
            && volume == 0.0
        {
            let message = format!("body {} has `{key}` and no volume", body.name);
            let help = "give `volume`, m3, of the fluid that it displaces";
            self.mistake(document.place(numbers[0]), &message, "water and air act on its volume", help);
        } else if volume > 0.0 && document.water.is_none() && document.air.is_none() {
            let message = format!("body {} has a volume, and the model has no water", body.name);
            self.mistake(document.place(body.volume), &message, "a section [water] or [air] is missing", ADD_FLUID);
        }
    }

    /// Drag along a beam counts with an area that conventions differ in.
    fn check_drag_area(&mut self, section: &SectionSpec) {
        let immersion = &section.immersion;
        let Some([_, along]) = immersion.drag else { return };
        let is_zero = self.document.function(along).is_constant() && self.document.value(along) == 0.0;
        if immersion.drag_area.is_none() && !is_zero {
            let message = format!("section {} has a drag along the beam without its area", section.name);
            let help = "drag_area = \"diameter\" counts D per length (DNV's values for chains), and \
                        drag_area = \"circumference\" pi D (MoorDyn, OrcaFlex)";
            self.mistake(self.document.place(along), &message, "`drag_area` is missing", help);
        }
    }

    /// The surface is level.
    fn check_gravity(&mut self, water: &WaterSpec) {
        let [x, y, z] = self.document.vector(self.document.model.gravity);
        if x != 0.0 || y != 0.0 || z > 0.0 {
            let message = "gravity is not along -z, and water has a level surface at a height z";
            let label = format!("gravity is [{x}, {y}, {z}]");
            self.mistake(water.place, message, &label, "draw the model with z upwards: gravity = [0, 0, -9.81]");
        }
    }

    /// Reports a beam on which `fluid` cannot act.
    fn check_beam_in(&mut self, fluid: &str, beam: &BeamSpec) {
        let document = self.document;
        let Some(section) = document.sections.get(beam.section) else { return };
        let value = |number: Number| document.value(number);
        let Some(diameter) = outer_diameter(section, value) else {
            let message =
                format!("beam {} is in {fluid}, and its section {} has no outer diameter", beam.name, section.name);
            let help = format!(
                "give `outer_diameter`: {fluid} acts on beams as on round ones of this diameter, and 0 keeps it off"
            );
            self.mistake(section.place, &message, "only a circle and a tube have one by their shape", &help);
            return;
        };
        if diameter == 0.0 {
            return;
        }
        if matches!(beam.formulation, Elements::Ancf24 { .. }) {
            let message = format!("beam {} is in {fluid}, which acts on elements of ancf14 only", beam.name);
            self.mistake(beam.place, &message, "its elements are of ancf24", KEEP_OFF);
        }
        let paid_out = document
            .winches
            .iter()
            .find(|winch| document.beams.get(winch.beam).is_some_and(|own| own.name == beam.name));
        if let Some(winch) = paid_out {
            let message = format!("winch {} pays out beam {}, which is in {fluid}", winch.name, beam.name);
            let label = format!("{fluid} does not act on a beam that is paid out");
            self.mistake(winch.place, &message, &label, KEEP_OFF);
        }
    }
}

/// Whether air acts on a beam.
fn meets_air(document: &Document, beam: &BeamSpec) -> bool {
    document.sections.get(beam.section).is_some_and(|own| own.immersion.meets_air())
}
