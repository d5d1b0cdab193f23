//! Files of MATLAB, level 5, not compressed: what MATLAB, Octave and `scipy.io.loadmat` read.
//!
//! A file is a header of 128 bytes and a row of elements; an element is a tag of 8 bytes, its type and length, and its
//! data, padded to a multiple of 8 bytes. A variable is an element of elements: flags, dimensions, name, values.

/// The value of a variable.
#[derive(Clone, Debug)]
pub enum Value<'a> {
    /// A matrix, column after column, with so many rows and columns.
    Matrix(&'a [f64], [usize; 2]),
    /// Texts, as a column of cells.
    Texts(Vec<&'a str>),
    /// A text.
    Text(&'a str),
    /// Values by name.
    Structure(Vec<(&'a str, Value<'a>)>),
}

const INT8: u32 = 1;
const UINT16: u32 = 4;
const INT32: u32 = 5;
const UINT32: u32 = 6;
const DOUBLE: u32 = 9;
const MATRIX: u32 = 14;

const CELL_CLASS: u32 = 1;
const STRUCTURE_CLASS: u32 = 2;
const CHAR_CLASS: u32 = 4;
const DOUBLE_CLASS: u32 = 6;

/// Bytes of a name of a field, its end included.
const FIELD: usize = 32;
/// Bytes of the text that a file begins with.
const HEADER: usize = 116;

/// The bytes of a file with the variables `variables`. The same values give the same bytes.
pub fn file(variables: &[(&str, Value<'_>)]) -> Vec<u8> {
    let mut bytes = b"MATLAB 5.0 MAT-file, written by ancf14".to_vec();
    bytes.resize(HEADER, b' ');
    bytes.extend([0; 8]);
    // The version, and in which order the bytes of a number are.
    bytes.extend([0x00, 0x01, b'I', b'M']);
    for (name, value) in variables {
        bytes.extend(variable(name, value));
    }
    bytes
}

/// The element of a variable; those inside another one have no name.
fn variable(name: &str, value: &Value<'_>) -> Vec<u8> {
    let (class, dimensions, body) = match value {
        Value::Matrix(values, dimensions) => {
            let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
            (DOUBLE_CLASS, *dimensions, element(DOUBLE, &bytes))
        }
        Value::Text(text) => {
            let letters: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
            (CHAR_CLASS, [usize::from(!letters.is_empty()), letters.len() / 2], element(UINT16, &letters))
        }
        Value::Texts(texts) => {
            let cells = texts.iter().flat_map(|text| variable("", &Value::Text(text))).collect();
            (CELL_CLASS, [texts.len(), 1], cells)
        }
        Value::Structure(fields) => {
            let mut names = Vec::new();
            for (name, _) in fields {
                let end = names.len() + FIELD;
                names.extend(name.bytes().take(FIELD - 1));
                names.resize(end, 0);
            }
            let mut body = element(INT32, &(FIELD as u32).to_le_bytes());
            body.extend(element(INT8, &names));
            fields.iter().for_each(|(_, value)| body.extend(variable("", value)));
            (STRUCTURE_CLASS, [1, 1], body)
        }
    };
    let flags: Vec<u8> = [class, 0].into_iter().flat_map(u32::to_le_bytes).collect();
    let sizes: Vec<u8> = dimensions.into_iter().flat_map(|size| (size as u32).to_le_bytes()).collect();
    let mut parts = element(UINT32, &flags);
    parts.extend(element(INT32, &sizes));
    parts.extend(element(INT8, name.as_bytes()));
    parts.extend(body);
    element(MATRIX, &parts)
}

/// An element: its tag and its data, padded.
fn element(kind: u32, data: &[u8]) -> Vec<u8> {
    let mut bytes: Vec<u8> = [kind, data.len() as u32].into_iter().flat_map(u32::to_le_bytes).collect();
    bytes.extend(data);
    bytes.resize(bytes.len().next_multiple_of(8), 0);
    bytes
}
