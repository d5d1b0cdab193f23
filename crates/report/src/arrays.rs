//! Arrays for numpy: an archive that `numpy.load` reads (NPZ), which is a zip archive with a file in the format NPY 1.0
//! for each array.

use std::io::{Cursor, Write};
use zip::{CompressionMethod, DateTime, ZipWriter, result::ZipResult, write::SimpleFileOptions};

/// The values of one array.
#[derive(Clone, Debug)]
pub enum Array<'a> {
    /// Doubles.
    Reals(&'a [f64]),
    /// Whole numbers of 32 bits.
    Integers(Vec<i32>),
    /// Texts; numpy pads them to one length.
    Words(Vec<&'a str>),
    /// A matrix of doubles, column after column, with so many rows.
    Matrix(&'a [f64], usize),
}

/// The bytes of an archive of named arrays, not compressed, because doubles hardly shrink. The same arrays give the
/// same bytes.
///
/// # Errors
/// The archive does not take an entry.
pub fn npz(arrays: &[(&str, Array<'_>)]) -> ZipResult<Vec<u8>> {
    let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, array) in arrays {
        let bytes = array.npy();
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Stored)
            .last_modified_time(DateTime::default())
            // Sizes of 64 bits, where 32 do not suffice.
            .large_file(u32::try_from(bytes.len()).is_err());
        archive.start_file(format!("{name}.npy"), options)?;
        archive.write_all(&bytes)?;
    }
    Ok(archive.finish()?.into_inner())
}

impl Array<'_> {
    /// The file of the array: magic, version, length of the header, header, values.
    fn npy(&self) -> Vec<u8> {
        let (kind, count, values): (String, usize, Vec<u8>) = match self {
            Self::Reals(values) => {
                ("<f8".to_owned(), values.len(), values.iter().flat_map(|value| value.to_le_bytes()).collect())
            }
            Self::Integers(values) => {
                ("<i4".to_owned(), values.len(), values.iter().flat_map(|value| value.to_le_bytes()).collect())
            }
            Self::Matrix(values, _) => {
                ("<f8".to_owned(), values.len(), values.iter().flat_map(|value| value.to_le_bytes()).collect())
            }
            Self::Words(words) => {
                let longest = words.iter().map(|word| word.chars().count()).max().unwrap_or(0).max(1);
                let padded =
                    |word: &&str| word.chars().chain(std::iter::repeat('\0')).take(longest).collect::<Vec<_>>();
                let values = words.iter().flat_map(padded).flat_map(|letter| u32::from(letter).to_le_bytes());
                (format!("<U{longest}"), words.len(), values.collect())
            }
        };
        let (order, shape) = match self {
            Self::Matrix(_, rows) => ("True", format!("({rows}, {})", count.checked_div(*rows).unwrap_or(0))),
            _ => ("False", format!("({count},)")),
        };
        let header = format!("{{'descr': '{kind}', 'fortran_order': {order}, 'shape': {shape}, }}");
        // Ten bytes stand before the header, a line feed ends it, and the values begin at a multiple of 64.
        let length = (10 + header.len() + 1).next_multiple_of(64) - 10;
        let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
        // A header of one or two dimensions has less than 182 bytes.
        bytes.extend((length as u16).to_le_bytes());
        bytes.extend(format!("{header:<width$}\n", width = length - 1).as_bytes());
        bytes.extend(values);
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The file of the numbers 1 and -2, byte by byte, as numpy 2.4 writes it:
    /// `numpy.save(file, numpy.array([1.0, -2.0]))`.
    #[test]
    fn a_file_as_numpy_writes_it() {
        let bytes = Array::Reals(&[1.0, -2.0]).npy();
        let header = "{'descr': '<f8', 'fortran_order': False, 'shape': (2,), }";
        let mut expected = b"\x93NUMPY\x01\x00\x76\x00".to_vec();
        expected.extend(format!("{header:<117}\n").bytes());
        expected.extend(1f64.to_le_bytes().into_iter().chain((-2f64).to_le_bytes()));
        assert_eq!(bytes, expected);
    }
}
