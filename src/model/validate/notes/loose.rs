//! Parts that nothing holds.

use super::groups::Groups;
use super::{Note, listed};
use crate::model::file::document::Document;
use crate::model::file::reader::anchor::Spot;

/// Says which parts no chain of joints and springs connects to the ground or to a frame.
pub fn loose_parts(document: &Document) -> Vec<Note> {
    // The last thing is the world.
    let world = document.beams.len() + document.bodies.len();
    let part = |spot: Spot| match spot {
        Spot::Ground | Spot::Frame(_) => world,
        Spot::Beam { beam, .. } => beam,
        Spot::Body(body) => document.beams.len() + body,
    };
    let joints = document.joints.iter().map(|joint| (joint.a, joint.b));
    let springs = document.springs.iter().filter_map(|spring| spring.ends().map(|[a, b]| (a, b)));
    let pairs = joints.chain(springs).map(|(a, b)| (part(a.spot), part(b.spot)));
    // A beam that may come to lie on something is not lost.
    let contacts = document
        .contacts
        .iter()
        .flat_map(|contact| contact.pairs().map(|(beam, surface)| (beam, part(document.surfaces[surface].on))));
    let beams = document.contacts.iter().flat_map(|contact| contact.beam_pairs());
    let foundations = document.foundations.iter().map(|foundation| (foundation.beam, world));
    let ropes = document.ropes.iter().flat_map(|rope| {
        let ends = rope.points().map(|end| part(end.spot));
        let wheels = rope.wheels().map(|(surface, _)| part(document.surfaces[surface].on));
        let parts: Vec<_> = ends.chain(wheels).collect();
        parts.windows(2).map(|pair| (pair[0], pair[1])).collect::<Vec<_>>()
    });
    // The water carries what has a volume in it.
    let bodies = document.bodies.iter().enumerate().filter(|(_, body)| document.value(body.volume) > 0.0);
    let wet = (0..document.beams.len()).chain(bodies.map(|(number, _)| document.beams.len() + number));
    let afloat = wet.filter(|_| document.water.is_some()).map(|part| (part, world));
    let held = pairs.chain(contacts).chain(beams).chain(foundations).chain(ropes).chain(afloat);
    let groups = Groups::new(world + 1, held);

    let beams = document.beams.iter().map(|beam| (format!("beam {}", beam.name), beam.place));
    let bodies = document.bodies.iter().map(|body| (format!("body {}", body.name), body.place));
    let parts: Vec<_> = beams.chain(bodies).collect();
    let loose: Vec<usize> = (0..world).filter(|own| !groups.are_connected(*own, world)).collect();
    let Some(first) = loose.first() else { return Vec::new() };
    let is_alone = |own: usize| (0..world).filter(|other| groups.are_connected(own, *other)).count() == 1;
    let to = "no joint or spring connects";
    let text = match loose.as_slice() {
        [one] if world > 1 && is_alone(*one) => {
            format!("{} is connected to nothing: it moves freely. Connect it by a joint or a spring", parts[*one].0)
        }
        all if all.len() == world => format!(
            "nothing holds the mechanism: {to} it to the ground or to a frame, and it moves freely. If it should be held, add a joint with a = \"ground\""
        ),
        some => {
            let names: Vec<&str> = some.iter().map(|part| parts[*part].0.as_str()).collect();
            format!("{to} {} to the ground or to a frame: they move freely. Add a joint or a spring", listed(&names))
        }
    };
    vec![Note { place: parts[*first].1, text }]
}
