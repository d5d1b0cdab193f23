//! Does an expression mean what mathematics means by it, and are its derivatives exact? The oracle is the second-order
//! dual number of num-dual, an independent automatic differentiation; a wrong chain rule would differ in the first
//! digit.

use super::program::FUNCTIONS;
use super::{Jet, Variable, compile};
use num_dual::{Dual2_64, DualNum};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// Rounding of some ten operations on numbers around 1, and of two implementations of the same functions.
const ROUNDING: f64 = 1e-11;

fn jet(text: &str, t: f64) -> Jet {
    let lookup = |name: &str| ["P", "T"].iter().position(|known| *known == name);
    let program = compile(text, Variable::Time, &lookup).unwrap_or_else(|error| panic!("{text}: {}", error.message));
    program.jet(t, |place| [3.0, 0.4][place])
}

fn value(text: &str) -> f64 {
    jet(text, 2.0).value
}

fn message(text: &str) -> (String, std::ops::Range<usize>) {
    let error = compile(text, Variable::None, &|_| None).expect_err(text);
    (error.message, error.range)
}

#[track_caller]
fn assert_jet(actual: Jet, expected: Dual2_64, what: &str) {
    for (actual, expected) in [(actual.value, expected.re), (actual.first, expected.v1), (actual.second, expected.v2)] {
        let close = (actual - expected).abs() <= ROUNDING * (1.0 + expected.abs());
        assert!(close || (actual.is_nan() && expected.is_nan()), "{what}: {actual} is not {expected}");
    }
}

/// The power binds tightest and from the right, above the sign; the rest is school.
#[test]
fn precedence_is_that_of_mathematics() {
    for (text, expected) in [
        ("1 + 2*3", 7.0),
        ("(1 + 2)*3", 9.0),
        ("7 - 4 - 2", 1.0),
        ("16/4/2", 2.0),
        ("2^3^2", 512.0),
        ("-2^2", -4.0),
        ("(-2)^2", 4.0),
        ("(-2)^3", -8.0),
        ("2^-1", 0.5),
        ("2*-3", -6.0),
        ("--3", 3.0),
        ("+3 - +1", 2.0),
        ("6/2*3", 9.0),
        ("1e-3*1E3", 1.0),
        ("2.5e+1 + .5 + 1.", 26.5),
        ("2*e", 2.0 * std::f64::consts::E),
        (" pi ", std::f64::consts::PI),
        ("min(3, 1, 2) + max(1, 5, 2)", 6.0),
        ("atan2(1, -1)", 0.75 * std::f64::consts::PI),
        ("sign(-3) + sign(0) + 2*sign(9)", 1.0),
        ("abs(-P)*T", 3.0 * 0.4),
        ("0.5*pi*(1 - cos(pi*t/4))", 0.5 * std::f64::consts::PI),
    ] {
        assert!((value(text) - expected).abs() < 1e-14, "{text} = {}", value(text));
    }
}

/// One function at a point inside its domain, by num-dual.
fn oracle(name: &str, x: Dual2_64, y: Dual2_64) -> Dual2_64 {
    match name {
        "sin" => x.sin(),
        "cos" => x.cos(),
        "tan" => x.tan(),
        "asin" => x.asin(),
        "acos" => x.acos(),
        "atan" => x.atan(),
        "atan2" => x.atan2(y),
        "sinh" => x.sinh(),
        "cosh" => x.cosh(),
        "tanh" => x.tanh(),
        "exp" => x.exp(),
        "ln" => x.ln(),
        "sqrt" => x.sqrt(),
        "abs" => x * x.re.signum(),
        "sign" => Dual2_64::from(x.re.signum()),
        "min" => {
            if x.re <= y.re || x.re.is_nan() {
                x
            } else {
                y
            }
        }
        "max" => {
            if x.re >= y.re || x.re.is_nan() {
                x
            } else {
                y
            }
        }
        _ => panic!("no oracle for {name}"),
    }
}

/// Every function of the language, of an argument that changes with slope and curvature.
#[test]
fn functions_have_exact_derivatives() {
    for (name, callable) in FUNCTIONS {
        for t in [0.17, 0.31, 0.66] {
            let time = Dual2_64::from(t).derivative();
            let (x, y) = (time * time - time * 0.3 + 0.1, (time * 2.0).sin() - 0.7);
            let text = match callable {
                super::program::Callable::One(_) => format!("{name}(t^2 - 0.3*t + 0.1)"),
                _ => format!("{name}(t^2 - 0.3*t + 0.1, sin(2*t) - 0.7)"),
            };
            assert_jet(jet(&text, t), oracle(name, x, y), &format!("{text} at {t}"));
        }
    }
}

/// Functions of pieces have the derivatives of the piece; comparisons and counts are constants.
#[test]
fn functions_with_jumps_have_the_derivatives_of_their_pieces() {
    for t in [0.17, 0.31, 0.66] {
        let time = Dual2_64::from(t).derivative();
        let (x, y) = (time * time - time * 0.3 + 1.1, (time * 2.0).sin() - 0.1);
        let (a, b) = ("(t^2 - 0.3*t + 1.1)", "(sin(2*t) - 0.1)");
        let zero = Dual2_64::from(0.0);
        let smooth = |u: Dual2_64| match u.re {
            share if share <= 0.0 => zero,
            share if share >= 1.0 => Dual2_64::from(1.0),
            _ => u * u * (-u * 2.0 + 3.0),
        };
        for (text, expected) in [
            (format!("log10({a})"), x.log10()),
            (format!("mod({a}, {b})"), x - y * (x.re / y.re).floor()),
            (format!("mod({b}, 0.2)"), y - 0.2 * (y.re / 0.2).floor()),
            (format!("floor(5*{a})"), Dual2_64::from((5.0 * x.re).floor())),
            (format!("ceil(5*{a})"), Dual2_64::from((5.0 * x.re).ceil())),
            (format!("step(0.4, {b})"), Dual2_64::from(f64::from(u8::from(y.re >= 0.4)))),
            (format!("smoothstep(0.1, {a}, {b})"), smooth((y - 0.1) / (x - 0.1))),
            (format!("if({b} < 0.4, {a}, {b})"), if y.re < 0.4 { x } else { y }),
            (format!("({b} < 0.4)*{a}"), if y.re < 0.4 { x } else { zero }),
        ] {
            assert_jet(jet(&text, t), expected, &format!("{text} at {t}"));
        }
    }
}

/// Comparisons are 1 or 0; `and` binds tighter than `or`, and both weaker than comparisons. A branch that is not taken
/// may be undefined.
#[test]
fn comparisons_and_conditions() {
    for (text, expected) in [
        ("1 < 2", 1.0),
        ("2 < 1 + 1", 0.0),
        ("2 <= 1 + 1 and 3 >= 3", 1.0),
        ("1 == 1 or 1 == 2 and 1 == 2", 1.0),
        ("(1 == 1 or 1 == 2) and 1 != 1", 0.0),
        ("3 > 2 and 2 > 3", 0.0),
        ("if(t > 3, sqrt(t - 3), 7)", 7.0),
        ("mod(36, 36) + mod(-1, 36) + mod(37, 36)", 36.0),
        ("mod(5, -3)", -1.0),
        ("step(2, t) + step(2.1, t)", 1.0),
        ("smoothstep(1, 3, t)", 0.5),
        ("smoothstep(2, 3, t) + smoothstep(1, 2, t)", 1.0),
        ("floor(-0.5) + ceil(-0.5)", -1.0),
    ] {
        assert!((value(text) - expected).abs() < 1e-14, "{text} = {}", value(text));
    }
    for text in ["if(sqrt(-1), 1, 2)", "sqrt(-1) < 1", "smoothstep(1, 1, t)", "mod(1, 0)"] {
        assert!(value(text).is_nan(), "{text} = {}", value(text));
    }
    assert_eq!(message("1 = 1").0, "`=` is not a comparison");
    assert_eq!(message("1 < 2 < 3").0, "two comparisons stand in a row");
    assert_eq!(message("if(1, 2)").0, "`if` has 2 argument(s) here");
    // The names of these functions are free for parameters.
    let program = compile("floor + 2*floor(1.5)", Variable::None, &|name| (name == "floor").then_some(0));
    assert_eq!(program.unwrap().value(0.0, |_| 3.0), 5.0);
}

/// Powers are the function with the most special cases: each by its closed form.
#[test]
fn powers_have_exact_derivatives_at_their_special_points() {
    for (text, t, expected) in [
        ("t^2", 0.0, [0.0, 0.0, 2.0]),
        ("t^1", 0.0, [0.0, 1.0, 0.0]),
        ("t^0", 0.0, [1.0, 0.0, 0.0]),
        ("t^3", -2.0, [-8.0, 12.0, -12.0]),
        ("t^-1", -2.0, [-0.5, -0.25, -0.25]),
        ("0^t", 2.0, [0.0, 0.0, 0.0]),
        ("2^t", 0.0, [1.0, std::f64::consts::LN_2, std::f64::consts::LN_2.powi(2)]),
        ("t^t", 1.0, [1.0, 1.0, 2.0]),
        ("sqrt(0*P) + t", 1.0, [1.0, 1.0, 0.0]),
        ("P/T", 1.0, [7.5, 0.0, 0.0]),
        ("tanh(800*t)", 1.0, [1.0, 0.0, 0.0]),
    ] {
        let jet = jet(text, t);
        for (actual, expected) in [jet.value, jet.first, jet.second].iter().zip(expected) {
            assert!((actual - expected).abs() < 1e-13, "{text} at {t}: {jet:?}");
        }
    }
}

/// Outside a function's domain the result is NaN, also through min and max: the caller must see it.
#[test]
fn domain_errors_are_not_swallowed() {
    for text in ["sqrt(-1)", "ln(-1)", "asin(2)", "acos(-2)", "(-8)^(1/3)", "0/0", "min(sqrt(-t), 1)", "max(1, ln(-t))"]
    {
        assert!(value(text).is_nan(), "{text} = {}", value(text));
    }
}

/// A random expression: its text, and the same by num-dual.
#[derive(Clone, Debug)]
enum Tree {
    Number(u32),
    Time,
    Unary(&'static str, Box<Tree>),
    Binary(&'static str, Box<Tree>, Box<Tree>),
}

impl Tree {
    fn text(&self) -> String {
        match self {
            Self::Number(value) => format!("{}", f64::from(*value) / 8.0),
            Self::Time => "t".to_owned(),
            Self::Unary(name, a) => format!("{name}({})", a.text()),
            Self::Binary(name, a, b) if name.len() == 1 => format!("({}) {name} ({})", a.text(), b.text()),
            Self::Binary(name, a, b) => format!("{name}({}, {})", a.text(), b.text()),
        }
    }

    fn oracle(&self, t: Dual2_64) -> Dual2_64 {
        match self {
            Self::Number(value) => Dual2_64::from(f64::from(*value) / 8.0),
            Self::Time => t,
            Self::Unary("-", a) => -a.oracle(t),
            Self::Unary(name, a) => oracle(name, a.oracle(t), t),
            Self::Binary(name, a, b) => {
                let (a, b) = (a.oracle(t), b.oracle(t));
                match *name {
                    "+" => a + b,
                    "-" => a - b,
                    "*" => a * b,
                    "/" => a / b,
                    _ => oracle(name, a, b),
                }
            }
        }
    }
}

fn tree() -> impl Strategy<Value = Tree> {
    let leaf = prop_oneof![(1_u32..30).prop_map(Tree::Number), Just(Tree::Time)];
    leaf.prop_recursive(5, 24, 2, |inner| {
        let unary = prop::sample::select(vec!["-", "sin", "cos", "atan", "tanh", "exp", "sqrt", "ln", "abs"]);
        let binary = prop::sample::select(vec!["+", "-", "*", "/", "min", "max"]);
        prop_oneof![
            (unary, inner.clone()).prop_map(|(name, a)| Tree::Unary(name, Box::new(a))),
            (binary, inner.clone(), inner).prop_map(|(name, a, b)| Tree::Binary(name, Box::new(a), Box::new(b))),
        ]
    })
}

// A fixed seed: the same cases in every run.
proptest! {
    #![proptest_config(ProptestConfig { cases: 256, rng_seed: RngSeed::Fixed(1), failure_persistence: None, ..ProptestConfig::default() })]

    /// Whatever is nested in whatever: value and both derivatives are those of num-dual.
    #[test]
    fn random_expressions_agree_with_num_dual(tree in tree(), t in 0.1_f64..2.0) {
        let expected = tree.oracle(Dual2_64::from(t).derivative());
        let size = expected.re.abs() + expected.v1.abs() + expected.v2.abs();
        // Beyond, the two cancel differently, or the formula is not defined.
        prop_assume!(size < 1e4);
        let actual = jet(&tree.text(), t);
        for (actual, expected) in [(actual.value, expected.re), (actual.first, expected.v1), (actual.second, expected.v2)] {
            prop_assert!((actual - expected).abs() < 1e-7 * (1.0 + size), "{}: {actual} is not {expected}", tree.text());
        }
    }

    /// Garbage is an error, never a panic.
    #[test]
    fn garbage_does_not_panic(text in "[-+*/^()., 0-9a-ez.tsinP\u{e4}]{0,40}") {
        let compiled = compile(&text, Variable::Time, &|_| None);
        if let Err(error) = compiled {
            prop_assert!(error.range.end <= text.len() && text.is_char_boundary(error.range.start));
            prop_assert!(!error.message.is_empty());
        }
    }
}

/// The message names the offending part and where it stands.
#[test]
fn mistakes_are_found_where_they_are() {
    for (text, expected, range) in [
        ("", "the expression is empty", 0..0),
        ("1 +", "the expression ends too early", 3..3),
        ("2pi", "unexpected `p` in the expression", 1..2),
        ("(1 + 2", "the expression ends too early", 6..6),
        ("1 + 2)", "unexpected `)` in the expression", 5..6),
        ("2*width", "unknown name `width` in the expression", 2..7),
        ("sin", "`sin` is a function", 0..3),
        ("sin(1, 2)", "`sin` has 2 argument(s) here", 0..3),
        ("atan2(1)", "`atan2` has 1 argument(s) here", 0..5),
        ("min(1)", "`min` has 1 argument(s) here", 0..3),
        ("2*t", "`t` is not known here", 2..3),
        ("s", "`s` is not known here", 0..1),
        ("2**3", "`**` is no operator", 1..3),
        ("1e999", "the number is too large", 0..5),
        ("pi(2)", "`pi` is no function", 0..2),
        ("3 ä", "unexpected `ä` in the expression", 2..4),
    ] {
        assert_eq!(message(text), (expected.to_owned(), range), "{text}");
    }
}

/// No file may overflow the stack, of the parser or of the evaluation.
#[test]
fn nesting_is_bounded() {
    let deep = |open: &str, n: usize, close: &str| format!("{}1{}", open.repeat(n), close.repeat(n));
    for text in [deep("(", 1500, ")"), deep("-", 3000, ""), deep("2^", 1500, ""), deep("1+2*(", 600, ")")] {
        assert_eq!(message(&text).0, "the expression is nested too deeply");
    }
    assert!(message(&"1+".repeat(3000)).0.contains("the limit is"));
    assert_eq!(value(&deep("(", 25, ")")), 1.0, "what people write is not too deep");
    assert_eq!(value(&format!("{}1", "1+".repeat(1500))), 1501.0, "long is not deep");
    assert_eq!(value(&format!("max({}7)", "1,".repeat(500))), 7.0, "nor are many arguments");
}
