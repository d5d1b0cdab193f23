//! A place and a connection of one name, as a point `pin` and the joint `pin` at it: which one the `at` of an output
//! means.

use crate::model::file::quantity::QUANTITIES;
use crate::model::file::reader::Reader;
use crate::model::text::names::{Kind, Named};

/// Which of a connection and a place of one name an output means: the one that has its quantities. None, with a report:
/// both have.
pub(super) fn which(reader: &mut Reader<'_, '_>, connection: Named, place: Named) -> Option<Named> {
    let words = reader.texts_of("quantities");
    let rows = || QUANTITIES.iter().filter(|row| words.iter().any(|word| word == row.word));
    let has = |kind: Kind| rows().all(|row| row.sites.iter().any(|site| site.words().contains(kind.word())));
    match [connection.kind, place.kind].map(has) {
        [true, false] => Some(connection),
        [false, true] => Some(place),
        _ => {
            let words = [&place, &connection].map(|named| named.kind.word());
            let message = format!("`{}` is a {} and a {}", place.name, words[0], words[1]);
            let free = reader.context.names.free_name(&connection.name, connection.kind);
            let help = format!("call the {} `{free}`, for instance", words[1]);
            let at = reader.take("at").map_or(reader.place, |entry| entry.item.place);
            reader.context.report.error(at, &message, "both have these quantities", &help);
            None
        }
    }
}
