//! Numbers as text: exact for programs, rounded for people.

/// The shortest text that reads back to the same double.
pub fn shortest(value: f64) -> String {
    let (plain, exponent) = (format!("{value}"), format!("{value:e}"));
    if exponent.len() < plain.len() { exponent } else { plain }
}

/// Digits that a number without an exponent may have besides the significant ones.
const MORE: i32 = 3;

/// So many significant digits, with an exponent where the number is small or has many more digits before the point.
pub fn significant(value: f64, digits: usize) -> String {
    if value == 0.0 {
        return String::from("0");
    }
    // Rounding may add a digit before the point: 9.99999 is 10.00.
    let rounded: f64 = format!("{value:.*e}", digits - 1).parse().unwrap_or(value);
    let before = rounded.abs().log10().floor().clamp(-300.0, 300.0) as i32 + 1;
    if (-3..=digits as i32 + MORE).contains(&before) {
        format!("{value:.*}", (digits as i32 - before).max(0) as usize)
    } else {
        format!("{value:.*e}", digits - 1)
    }
}

/// At most so many significant digits, without zeros at the end.
pub fn trimmed(value: f64, digits: usize) -> String {
    let text = significant(value, digits);
    match text.contains('.') && !text.contains('e') {
        true => text.trim_end_matches('0').trim_end_matches('.').to_owned(),
        false => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whatever the size, the text reads back exactly, and no other notation of Rust is shorter.
    #[test]
    fn shortest_text_reads_back() {
        for (value, text) in [
            (0.1, "0.1"),
            (-0.0, "-0"),
            (1e-300, "1e-300"),
            (1e21, "1e21"),
            (0.001, "1e-3"),
            (123456.75, "123456.75"),
            (1.0 / 3.0, "0.3333333333333333"),
            (5e-324, "5e-324"),
            (f64::MAX, "1.7976931348623157e308"),
        ] {
            assert_eq!(shortest(value), text);
            assert_eq!(text.parse::<f64>().map(f64::to_bits), Ok(value.to_bits()));
        }
    }

    /// Numbers for people have as many digits as they should, whatever their size.
    #[test]
    fn digits_are_significant() {
        for (value, digits, text) in [
            (9.0609999, 6, "9.06100"),
            (56.932, 6, "56.9320"),
            (123456.7, 6, "123457"),
            (1.5e-7, 6, "1.50000e-7"),
            (0.0123, 6, "0.0123000"),
            (-0.11004, 4, "-0.1100"),
            (9.99999, 4, "10.00"),
            (73e9, 4, "7.300e10"),
            (100440237.0, 4, "1.004e8"),
            (1234567.0, 4, "1234567"),
            (123456789.0, 6, "123456789"),
            (0.0, 4, "0"),
            (-0.0, 4, "0"),
        ] {
            assert_eq!(significant(value, digits), text);
        }
        let texts = [0.5, 12.0, 1200.0, 0.0, 1e-7, 0.12345].map(|value| trimmed(value, 4));
        assert_eq!(texts, ["0.5", "12", "1200", "0", "1.000e-7", "0.1235"]);
    }
}
