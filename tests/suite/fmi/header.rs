//! Do the C names of a model's header lead to its variables? A C compiler reads the header and prints them.

use std::{fs, process::Command};

use ancf14::fmi::{header::text, variable::Variable};

use super::toy;
use crate::golden;

/// The header of the toy, as reviewed.
#[test]
fn golden_header_of_the_toy() {
    golden::assert_current("tests/golden/toy.h", &text(&toy::about(), &toy::variables(), "Toy").unwrap());
}

/// Names that C cannot tell apart get their value reference behind them, and no name is a macro of the header.
#[test]
fn names_stay_apart() {
    let mut variables = toy::variables();
    variables[0].name = "a.b_c".to_owned();
    variables[1].name = "a_b.c".to_owned();
    variables[2].name = "GUID".to_owned();
    let text = text(&toy::about(), &variables, "M").unwrap();
    for line in ["M_a_b_c = 0,", "M_a_b_c_1 = 1,", "M_GUID_2 = 2,"] {
        assert!(text.contains(line), "{line} is missing in\n{text}");
    }
}

#[test]
fn prefixes_are_identifiers() {
    assert!(text(&toy::about(), &toy::variables(), "1M").is_err());
}

/// Compiles without a warning as C99 and as C++17, and the macro lists name, unit and reference of the outputs.
#[test]
fn compilers_read_it() {
    let directory = tempfile::tempdir().unwrap();
    let mut variables = toy::variables();
    variables[0].description = "ends */ the comment /* or not \\".to_owned();
    for (row, column) in [(1, 1), (1, 2), (2, 1), (2, 2), (3, 1), (3, 2)] {
        let name = format!("line.x[{row},{column}]");
        variables.push(Variable { name, ..variables[toy::POSITION as usize].clone() });
    }
    fs::write(directory.path().join("toy.h"), text(&toy::about(), &variables, "Toy").unwrap()).unwrap();
    let source = "#include \"toy.h\"\n#include <stdio.h>\n#define SHOW(r, n, u) printf(\"%d %s %s\\n\", (int)r, n, u);\n\
                  #define SIZED(r, n, u, rows, columns) printf(\"%d %s %s %d x %d\\n\", (int)r, n, u, rows, columns);\n\
                  int main(void) { Toy_REAL_OUTPUTS(SHOW) Toy_INTEGER_OUTPUTS(SHOW) Toy_FLOAT64_OUTPUTS(SIZED) return Toy_STOP_TIME > 0 ? 0 : 1; }\n";
    for (file, standard) in [("toy.c", "-std=c99"), ("toy.cpp", "-std=c++17")] {
        fs::write(directory.path().join(file), source).unwrap();
        let built = Command::new("cc")
            .current_dir(directory.path())
            .args([standard, "-Wall", "-Wextra", "-Werror", "-pedantic", file, "-o", "toy"])
            .output()
            .unwrap();
        assert!(built.status.success(), "{}", String::from_utf8_lossy(&built.stderr));
        let ran = Command::new(directory.path().join("toy")).output().unwrap();
        assert!(ran.status.success());
        assert_eq!(
            String::from_utf8_lossy(&ran.stdout),
            "4 tip.position[1] m\n8 line.x[1,1] m\n9 line.x[1,2] m\n10 line.x[2,1] m\n11 line.x[2,2] m\n\
             12 line.x[3,1] m\n13 line.x[3,2] m\n5 statistics.steps \n4 tip.position m 1 x 1\n8 line.x m 3 x 2\n"
        );
    }
}
