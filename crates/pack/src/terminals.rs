//! terminalsAndIcons/terminalsAndIcons.xml (FMI 3.0, section 2.4.9): a terminal for each part that a host gives something or reads something of.
//!
//! The variables `NAME.key` of inputs and outputs are the members of terminal `NAME`. Members match by name: an output with the position and the
//! quaternion of a point connects to the frame of another unit whose motion is an input.

use std::io;

use quick_xml::events::{BytesDecl, Event};

use crate::elements::{Attributes, Xml, borrowed, empty, parent, text};
use ancf14::fmi::arrays::{Array, arrays};
use ancf14::fmi::variable::{Causality, Variable};

/// Outputs of the whole mechanism, which no other unit connects to.
const TOTALS: [&str; 4] = ["energy", "momentum", "statistics", "work"];

/// Corners of the icon, in units of a tenth of a millimeter.
const CORNERS: [(&str, &str); 4] = [("x1", "-100"), ("y1", "-100"), ("x2", "100"), ("y2", "100")];

/// The text of terminalsAndIcons.xml.
pub fn xml(variables: &[Variable]) -> String {
    text(|xml| document(xml, variables))
}

fn document(xml: &mut Xml, variables: &[Variable]) -> io::Result<()> {
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let root = xml.create_element("fmiTerminalsAndIcons").with_attribute(("fmiVersion", "3.0"));
    let terminals = terminals(variables);
    root.write_inner_content(|xml| {
        parent(xml, "GraphicalRepresentation", |xml| {
            let corners = || -> Attributes<'_> { CORNERS.map(|(key, value)| (key, value.into())).into() };
            let scale = [("suggestedScalingFactorTo_mm", "0.1".into())];
            empty(xml, "CoordinateSystem", corners().into_iter().chain(scale).collect())?;
            empty(xml, "Icon", corners())
        })?;
        if terminals.is_empty() {
            return Ok(());
        }
        parent(xml, "Terminals", |xml| {
            terminals.iter().try_for_each(|(name, members)| terminal(xml, name, members, variables))
        })
    })?;
    Ok(())
}

/// The terminals with their members, in the order of their first variables.
fn terminals(variables: &[Variable]) -> Vec<(&str, Vec<Array<'_>>)> {
    let mut terminals: Vec<(&str, Vec<Array<'_>>)> = Vec::new();
    for array in arrays(variables) {
        let connects = matches!(variables[array.first].causality, Causality::Input | Causality::Output);
        let Some((name, _)) = array.name.rsplit_once('.').filter(|(name, _)| connects && !TOTALS.contains(name)) else {
            continue;
        };
        match terminals.iter_mut().find(|(other, _)| *other == name) {
            Some((_, members)) => members.push(array),
            None => terminals.push((name, vec![array])),
        }
    }
    terminals
}

fn terminal(xml: &mut Xml, name: &str, members: &[Array<'_>], variables: &[Variable]) -> io::Result<()> {
    let attributes: Attributes<'_> = vec![("name", name.into()), ("matchingRule", "bus".into())];
    xml.create_element("Terminal").with_attributes(borrowed(&attributes)).write_inner_content(|xml| {
        members.iter().try_for_each(|member| {
            let attributes = vec![
                ("variableName", member.name.into()),
                ("memberName", member_name(member, &variables[member.first]).into()),
                ("variableKind", "signal".into()),
            ];
            empty(xml, "TerminalMemberVariable", attributes)
        })
    })?;
    Ok(())
}

/// The quantity that a member is, under the name that outputs have for it: what one unit reads is what another one is given.
fn member_name<'a>(member: &Array<'a>, variable: &Variable) -> &'a str {
    let key = member.name.rsplit_once('.').map_or(member.name, |(_, key)| key);
    match (key, variable.quantity.unit.as_str()) {
        ("applied_force", _) => "force",
        ("applied_moment", _) => "moment",
        ("value", "rad") => "angle",
        ("value", "m") => "distance",
        ("rate", "rad/s") => "angle_rate",
        ("rate", "m/s") => "distance_rate",
        _ => key,
    }
}
