//! FMU states as bytes (FMI 2.0, section 2.1.8): a header that tells foreign, truncated and damaged bytes apart, then
//! the state.
//!
//! Header: magic, version of the layout, length and checksum of what follows; little endian. Then the GUID of the
//! model, the instance's own data and the model's. They may come from another process, and from anywhere: nothing is
//! believed that is not checked.

use super::{Control, FmuState, Instance};
use crate::fmi::{
    Model,
    error::Error,
    lifecycle::{Call, Mode},
};

/// First bytes of every serialized FMU state.
const MAGIC: Magic = *b"ancf14st";
/// Version of the layout: of the header and of all that models write.
const VERSION: u32 = 19;
/// Bytes of the header: magic, version, length, checksum.
pub const ROOM: usize = 8 + 4 + 8 + 4;

/// The first bytes of a kind of states.
pub type Magic = [u8; 8];

/// Why bytes are not a state of a kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flaw {
    /// They begin with something else; there are so many.
    Foreign(usize),
    /// They have this layout.
    Layout(u64),
    /// How many bytes were written behind the header, and how many are there.
    Length(u64, usize),
    /// They are damaged.
    Checksum,
}

impl std::fmt::Display for Flaw {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Foreign(count) => write!(f, "they do not begin as such a state does (there are {count} bytes)"),
            Self::Layout(version) => write!(f, "they have layout {version}, this library reads layout {VERSION}"),
            Self::Length(written, there) => {
                write!(f, "{written} bytes were written behind the header, {there} are there")
            }
            Self::Checksum => write!(f, "their checksum does not fit: they are damaged"),
        }
    }
}

impl<M: Model> Instance<M> {
    /// The bytes of a state (`fmi2SerializeFMUstate`, section 2.1.8).
    ///
    /// # Errors
    /// The mode does not allow `call`.
    pub fn serialize(&self, call: Call, state: &FmuState<M>) -> Result<Vec<u8>, Error> {
        self.check(call)?;
        let bytes = postcard::to_extend(&(&state.guid, state.control), vec![0; ROOM]);
        Ok(seal(&MAGIC, self.model.write(&state.model, bytes.expect("a Vec takes every byte"))))
    }

    /// The state that was serialized to `bytes`, of this or another instance, in this or another process (section
    /// 2.1.8).
    ///
    /// # Errors
    /// The mode does not allow it; or the bytes are foreign, truncated, damaged, or of another model or kind.
    pub fn deserialize(&self, bytes: &[u8]) -> Result<FmuState<M>, Error> {
        self.check(Call::DeSerializeFMUstate)?;
        let refused = |problem: String| Error::Serialized { problem };
        let content = content(&MAGIC, bytes).map_err(|flaw| refused(flaw.to_string()))?;
        let ((guid, control), model) =
            postcard::take_from_bytes::<(String, Control)>(content).map_err(|reason| refused(reason.to_string()))?;
        if control.mode == Mode::Update {
            return Err(refused(String::from("they are of the middle of a step, where no state is taken")));
        }
        let own = &self.model.about().guid;
        if guid != *own {
            return Err(Error::ForeignState { theirs: guid, own: own.clone() });
        }
        self.fits(control.mode)?;
        let model = self.model.read(model).map_err(|failure| refused(failure.message))?;
        Ok(FmuState { guid, control, model })
    }
}

/// Writes the header into the first [`ROOM`] of `bytes`, which are left for it.
pub fn seal(magic: &Magic, mut bytes: Vec<u8>) -> Vec<u8> {
    let (header, content) = bytes.split_at_mut(ROOM);
    header[..8].copy_from_slice(magic);
    header[8..12].copy_from_slice(&VERSION.to_le_bytes());
    header[12..20].copy_from_slice(&(content.len() as u64).to_le_bytes());
    header[20..].copy_from_slice(&crc32fast::hash(content).to_le_bytes());
    bytes
}

/// What stands behind the header, if it is what was written.
///
/// # Errors
/// It is not: the bytes are foreign, truncated or damaged, or of another version.
pub fn content<'a>(magic: &Magic, bytes: &'a [u8]) -> Result<&'a [u8], Flaw> {
    let split = bytes.split_at_checked(ROOM).filter(|(header, _)| header.starts_with(magic));
    let (header, content) = split.ok_or(Flaw::Foreign(bytes.len()))?;
    let version = number(&header[8..12]);
    if version != u64::from(VERSION) {
        return Err(Flaw::Layout(version));
    }
    let length = number(&header[12..20]);
    if length != content.len() as u64 {
        return Err(Flaw::Length(length, content.len()));
    }
    if number(&header[20..]) != u64::from(crc32fast::hash(content)) {
        return Err(Flaw::Checksum);
    }
    Ok(content)
}

/// A little-endian number.
fn number(bytes: &[u8]) -> u64 {
    bytes.iter().rev().fold(0, |number, byte| number << 8 | u64::from(*byte))
}
