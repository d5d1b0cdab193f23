//! terminalsAndIcons/terminalsAndIcons.xml (FMI 3.0, section 2.4.9; FMI 2.0.4 and later, section 2.3): a terminal for
//! each part that a host gives something or reads something of.
//!
//! The variables `NAME.key` of inputs and outputs are the members of terminal `NAME`. Members match by name: an output
//! with the position and the quaternion of a point connects to the frame of another unit whose motion is an input. FMI
//! 2.0 has no arrays: there each element is a member, `position[1]` to `position[3]`.

use std::io;

use quick_xml::events::{BytesDecl, Event};

use crate::elements::{Attributes, Xml, borrowed, empty, parent, text};
use ancf14::fmi::arrays::{Array, arrays};
use ancf14::fmi::lifecycle::Standard;
use ancf14::fmi::variable::{Causality, Variable};

/// Counts of steps, which no other unit connects to.
const COUNTS: &str = "statistics";

/// Corners of the icon, in units of a tenth of a millimeter.
const CORNERS: [(&str, &str); 4] = [("x1", "-100"), ("y1", "-100"), ("x2", "100"), ("y2", "100")];

/// The text of terminalsAndIcons.xml for units of a version of the standard.
pub fn xml(standard: Standard, variables: &[Variable]) -> String {
    text(|xml| document(xml, standard, variables))
}

fn document(xml: &mut Xml, standard: Standard, variables: &[Variable]) -> io::Result<()> {
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let root = xml.create_element("fmiTerminalsAndIcons").with_attribute(("fmiVersion", "3.0"));
    let terminals = terminals(variables);
    root.write_inner_content(|xml| {
        // Units of FMI 2.0 have their picture as model.png.
        if standard == Standard::Fmi3 {
            parent(xml, "GraphicalRepresentation", |xml| {
                let corners = || -> Attributes<'_> { CORNERS.map(|(key, value)| (key, value.into())).into() };
                let scale = [("suggestedScalingFactorTo_mm", "0.1".into())];
                empty(xml, "CoordinateSystem", corners().into_iter().chain(scale).collect())?;
                empty(xml, "Icon", corners())
            })?;
        }
        if terminals.is_empty() {
            return Ok(());
        }
        parent(xml, "Terminals", |xml| {
            terminals.iter().try_for_each(|(name, members)| terminal(xml, standard, name, members, variables))
        })
    })?;
    Ok(())
}

/// The terminals with their members, in the order of their first variables.
fn terminals(variables: &[Variable]) -> Vec<(&str, Vec<Array<'_>>)> {
    let mut terminals: Vec<(&str, Vec<Array<'_>>)> = Vec::new();
    for array in arrays(variables) {
        let connects = matches!(variables[array.first].causality, Causality::Input | Causality::Output);
        let Some((name, _)) = array.name.rsplit_once('.').filter(|(name, _)| connects && *name != COUNTS) else {
            continue;
        };
        match terminals.iter_mut().find(|(other, _)| *other == name) {
            Some((_, members)) => members.push(array),
            None => terminals.push((name, vec![array])),
        }
    }
    terminals
}

fn terminal(
    xml: &mut Xml,
    standard: Standard,
    name: &str,
    members: &[Array<'_>],
    variables: &[Variable],
) -> io::Result<()> {
    let attributes: Attributes<'_> = vec![("name", name.into()), ("matchingRule", "bus".into())];
    let member = |xml: &mut Xml, variable: &str, member: &str| {
        let attributes =
            vec![("variableName", variable.into()), ("memberName", member.into()), ("variableKind", "signal".into())];
        empty(xml, "TerminalMemberVariable", attributes)
    };
    xml.create_element("Terminal").with_attributes(borrowed(&attributes)).write_inner_content(|xml| {
        members.iter().try_for_each(|array| {
            let rows = &variables[array.first..array.first + array.elements()];
            let word = member_name(array, &rows[0]);
            match standard {
                Standard::Fmi3 => member(xml, array.name, word),
                Standard::Fmi2 => rows.iter().try_for_each(|row| {
                    let index = row.name.strip_prefix(array.name).expect("an array has the name of its elements");
                    member(xml, &row.name, &format!("{word}{index}"))
                }),
            }
        })
    })?;
    Ok(())
}

/// The quantity that a member is, under the name that outputs have for it: what one unit reads is what another one is
/// given.
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
