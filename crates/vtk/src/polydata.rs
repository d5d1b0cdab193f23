//! A file of VTK's XML format with points, lines or polygons, `.vtp`, and the list of such files over time, `.pvd`.
//!
//! Arrays stand behind the XML as they are in memory (appended, raw), each as one block of zlib, which is what ParaView
//! itself writes. The deflate of miniz_oxide does not look at the processor: the same numbers make the same bytes
//! everywhere.

use quick_xml::Writer;
use quick_xml::events::BytesText;
use std::io;

/// Effort of the compression, of 10: more effort makes files of doubles less than 2 % smaller.
const EFFORT: u8 = 4;

/// The array whose value VTK takes for the time of a file.
const TIME: &str = "TimeValue";

/// An array over points or cells.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    /// Its name in ParaView.
    pub name: &'static str,
    /// Unit label; empty: dimensionless.
    pub unit: &'static str,
    /// Numbers of each point or cell.
    pub components: usize,
    /// All of them.
    pub values: Values,
}

/// The content of an array.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Doubles.
    Reals(Vec<f64>),
    /// Whole numbers.
    Counts(Vec<usize>),
    /// Names.
    Words(Vec<String>),
}

/// What connects points.
#[derive(Clone, Debug, PartialEq)]
pub enum Cells {
    /// Each point is a cell.
    Points,
    /// Lines through points.
    Lines(Vec<Vec<usize>>),
    /// Flat polygons.
    Polygons(Vec<Vec<usize>>),
}

/// The content of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct PolyData {
    /// Places, global axes, m.
    pub points: Vec<[f64; 3]>,
    /// What connects them.
    pub cells: Cells,
    /// Arrays over the points.
    pub on_points: Vec<Array>,
    /// Arrays over the cells.
    pub on_cells: Vec<Array>,
}

impl Array {
    /// Doubles, `components` of each point or cell.
    pub fn reals(name: &'static str, unit: &'static str, components: usize, values: Vec<f64>) -> Self {
        Self { name, unit, components, values: Values::Reals(values) }
    }

    /// A whole number of each point or cell.
    pub fn counts(name: &'static str, values: Vec<usize>) -> Self {
        Self { name, unit: "", components: 1, values: Values::Counts(values) }
    }

    /// The name of each point or cell.
    pub fn names(values: Vec<String>) -> Self {
        Self { name: "name", unit: "", components: 1, values: Values::Words(values) }
    }
}

impl Cells {
    /// Their tag in the file, and the points of each; points are themselves.
    fn tagged(&self, points: usize) -> (&'static str, Vec<Vec<usize>>) {
        match self {
            Self::Points => ("Verts", (0..points).map(|point| vec![point]).collect()),
            Self::Lines(lines) => ("Lines", lines.clone()),
            Self::Polygons(polygons) => ("Polys", polygons.clone()),
        }
    }
}

/// What stands behind the XML.
#[derive(Default)]
struct Appended(Vec<u8>);

impl Appended {
    /// Writes the tag of an array, and appends its numbers.
    fn array(&mut self, xml: &mut Xml, array: &Array) -> io::Result<()> {
        let (tag, kind, count, bytes): (_, _, _, Vec<u8>) = match &array.values {
            Values::Reals(all) => {
                ("DataArray", "Float64", all.len(), all.iter().flat_map(|n| n.to_le_bytes()).collect())
            }
            Values::Counts(all) => {
                ("DataArray", "Int64", all.len(), all.iter().flat_map(|n| (*n as u64).to_le_bytes()).collect())
            }
            // Each word ends with a zero byte.
            Values::Words(all) => {
                ("Array", "String", all.len(), all.iter().flat_map(|word| word.bytes().chain([0])).collect())
            }
        };
        let [components, tuples, offset] =
            [array.components, count / array.components, self.0.len()].map(|number| number.to_string());
        let element = xml.create_element(tag).with_attributes([
            ("type", kind),
            ("Name", array.name),
            ("NumberOfComponents", &components),
            ("NumberOfTuples", &tuples),
            ("format", "appended"),
            ("offset", &offset),
        ]);
        if array.unit.is_empty() {
            element.write_empty()?;
        } else {
            element.write_inner_content(|xml| {
                let key = xml.create_element("InformationKey");
                let key = key.with_attributes([("name", "UNITS_LABEL"), ("location", "vtkDataArray")]);
                key.write_text_content(BytesText::new(array.unit)).map(drop)
            })?;
        }
        self.append(&bytes);
        Ok(())
    }

    /// Appends bytes: number of blocks, size of each, size of a last one that is smaller (0: none), compressed sizes,
    /// blocks.
    fn append(&mut self, bytes: &[u8]) {
        let mut number = |number: usize| self.0.extend((number as u64).to_le_bytes());
        if bytes.is_empty() {
            [0; 3].into_iter().for_each(number);
            return;
        }
        let block = miniz_oxide::deflate::compress_to_vec_zlib(bytes, EFFORT);
        [1, bytes.len(), 0, block.len()].into_iter().for_each(&mut number);
        self.0.extend(block);
    }

    /// Writes an element with arrays in it.
    fn arrays(&mut self, xml: &mut Xml, tag: &str, arrays: &[Array]) -> io::Result<()> {
        let element = xml.create_element(tag);
        element.write_inner_content(|xml| arrays.iter().try_for_each(|array| self.array(xml, array))).map(drop)
    }
}

impl PolyData {
    /// The file, of the instant `time`, s.
    pub fn file(&self, time: f64) -> Vec<u8> {
        let mut appended = Appended::default();
        let xml = text(|xml| self.write(xml, &mut appended, time));
        [head(KIND).as_bytes(), &xml, b"\n<AppendedData encoding=\"raw\">\n_", &appended.0, b"\n</AppendedData>", END]
            .concat()
    }

    fn write(&self, xml: &mut Xml, appended: &mut Appended, time: f64) -> io::Result<()> {
        let (tag, cells) = self.cells.tagged(self.points.len());
        let mut end = 0;
        let ends = cells.iter().map(|cell| {
            end += cell.len();
            end
        });
        let ends = Array::counts("offsets", ends.collect());
        let connected = [Array::counts("connectivity", cells.concat()), ends];
        let points = [Array::reals("Points", "m", 3, self.points.concat())];
        let kinds = [("NumberOfVerts", "Verts"), ("NumberOfLines", "Lines"), ("NumberOfPolys", "Polys")];
        let counts = kinds.map(|(name, own)| (name, if own == tag { cells.len() } else { 0 }.to_string()));
        let count = ("NumberOfPoints", self.points.len().to_string());
        let counts = [count].into_iter().chain(counts).collect::<Vec<_>>();
        let counts = counts.iter().map(|(name, count)| (*name, count.as_str()));
        let time = [Array::reals(TIME, "s", 1, vec![time])];
        let all = xml.create_element(KIND).write_inner_content(|xml| {
            appended.arrays(xml, "FieldData", &time)?;
            let piece = xml.create_element("Piece").with_attributes(counts);
            let piece = piece.write_inner_content(|xml| {
                appended.arrays(xml, "PointData", &self.on_points)?;
                appended.arrays(xml, "CellData", &self.on_cells)?;
                appended.arrays(xml, "Points", &points)?;
                appended.arrays(xml, tag, &connected)
            });
            piece.map(drop)
        });
        all.map(drop)
    }
}

/// The list of files over time: names and instants, s.
pub fn collection(files: &[(String, f64)]) -> Vec<u8> {
    let kind = "Collection";
    let xml = text(|xml| {
        let all = xml.create_element(kind).write_inner_content(|xml| {
            files.iter().try_for_each(|(name, time)| {
                let entry = xml.create_element("DataSet");
                let entry = entry.with_attributes([("timestep", &*time.to_string()), ("part", "0"), ("file", name)]);
                entry.write_empty().map(drop)
            })
        });
        all.map(drop)
    });
    [head(kind).as_bytes(), &xml, END].concat()
}

type Xml = Writer<Vec<u8>>;

/// The kind of data in a file.
const KIND: &str = "PolyData";
const END: &[u8] = b"\n</VTKFile>\n";

fn head(kind: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"{kind}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" \
         compressor=\"vtkZLibDataCompressor\">\n"
    )
}

/// The text that `write` writes.
fn text(write: impl FnOnce(&mut Xml) -> io::Result<()>) -> Vec<u8> {
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 1);
    write(&mut xml).expect("a Vec takes every byte");
    xml.into_inner()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bytes of each array of a file, by its name.
    fn arrays(file: &[u8]) -> Vec<(String, Vec<u8>)> {
        let mark = b"<AppendedData encoding=\"raw\">\n_";
        let begin = file.windows(mark.len()).position(|window| window == mark).unwrap();
        let (xml, data) = (std::str::from_utf8(&file[..begin]).unwrap(), &file[begin + mark.len()..]);
        let quoted = |tag: &str, key: &str| Some(tag.split_once(&format!("{key}=\""))?.1.split_once('"')?.0.to_owned());
        let tags = xml.split('<').filter(|tag| tag.starts_with("DataArray") || tag.starts_with("Array"));
        let array = |tag: &str| {
            let at: usize = quoted(tag, "offset").unwrap().parse().unwrap();
            let number = |place: usize| u64::from_le_bytes(data[at + 8 * place..][..8].try_into().unwrap()) as usize;
            let blocks: Vec<usize> = (0..number(0)).map(|block| number(3 + block)).collect();
            let mut begin = at + 8 * (3 + blocks.len());
            let mut bytes = Vec::new();
            for size in blocks {
                bytes.extend(miniz_oxide::inflate::decompress_to_vec_zlib(&data[begin..begin + size]).unwrap());
                assert_eq!(bytes.len(), number(1));
                begin += size;
            }
            (quoted(tag, " Name").unwrap(), bytes)
        };
        tags.map(array).collect()
    }

    /// What is written is what is read: numbers bit for bit, whole numbers, names of any letters, and arrays without
    /// anything in them.
    #[test]
    fn arrays_are_read_back() {
        let numbers = [0.1, f64::NAN, -0.0, 1e-300];
        let of = |cells: Cells| PolyData {
            points: vec![[0.1, f64::NAN, -0.0], [1e-300, 0.0, 0.0]],
            cells,
            on_points: vec![Array::reals("stress", "Pa", 2, numbers.to_vec())],
            on_cells: vec![Array::names(vec!["a<b".to_owned(), "é".to_owned()])],
        };
        let found = arrays(&of(Cells::Points).file(0.25));
        let bytes = |numbers: &[f64]| numbers.iter().flat_map(|number| number.to_le_bytes()).collect::<Vec<u8>>();
        let counts = |numbers: &[u64]| numbers.iter().flat_map(|number| number.to_le_bytes()).collect::<Vec<u8>>();
        let wanted: Vec<(&str, Vec<u8>)> = vec![
            ("TimeValue", bytes(&[0.25])),
            ("stress", bytes(&numbers)),
            ("name", "a<b\0é\0".as_bytes().to_vec()),
            ("Points", bytes(&[0.1, f64::NAN, -0.0, 1e-300, 0.0, 0.0])),
            ("connectivity", counts(&[0, 1])),
            ("offsets", counts(&[1, 2])),
        ];
        let found: Vec<(&str, Vec<u8>)> = found.iter().map(|(name, bytes)| (name.as_str(), bytes.clone())).collect();
        assert_eq!(found, wanted);
        let lines = arrays(&of(Cells::Lines(vec![vec![1, 0, 1], vec![0, 1]])).file(0.0));
        assert_eq!(lines[4].1, counts(&[1, 0, 1, 0, 1]));
        assert_eq!(lines[5].1, counts(&[3, 5]));
        assert!(arrays(&of(Cells::Polygons(Vec::new())).file(0.0))[4].1.is_empty());
    }
}
