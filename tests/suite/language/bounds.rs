//! Bounds of an expression over an interval must enclose its values and derivatives there, and must not exclude a
//! switch that happens: the ends of steps rest on both. A wrong sign in an operation, or an extreme that is not looked
//! for, would let a pulse pass.

use crate::random::Random;
use ancf14::math::range::Range;
use ancf14::model::document::Document;
use ancf14::model::expression::function::Function;

/// A function of time, as a load.
fn function(expression: &str, more: &str) -> Function {
    let text = format!(
        "format = 1\nmodel.name = \"F\"\n[body.b]\nmass = 1\nposition = [0, 0, 0]\ninertia = [1, 1, 1]\n\
         [load.l]\nat = \"b\"\nforce = [\"{expression}\", 0, 0]\n[simulation]\nstop = 1\n{more}"
    );
    let document = Document::parse("m.toml", &text, &[]).unwrap_or_else(|message| panic!("{message}"));
    document.function(document.loads[0].force[0])
}

const ROWS: &str = "table = [[-3, 1], [-1, 2], [-0.5, -1], [0.5, -1], [0.75, 4], [2, 0.5], [3, 1]]";

/// Whether `range` has `value`, but for the round-off of sums of terms of its size.
fn holds(range: Range, value: f64) -> bool {
    let slack = 1e-9 * (1.0 + value.abs());
    range.low - slack <= value && value <= range.high + slack
}

/// Random points of random intervals, from 6 down to 1e-6 long.
#[test]
fn bounds_enclose_values_and_derivatives() {
    let tables: String = ["linear", "monotone"]
        .iter()
        .flat_map(|kind| ["hold", "repeat"].map(|outside| (*kind, outside)))
        .map(|(kind, outside)| {
            format!("[function.{kind}_{outside}]\n{ROWS}\ninterpolation = \"{kind}\"\noutside = \"{outside}\"\n")
        })
        .collect();
    let more = format!("{tables}[function.g]\nargument = \"x\"\nvalue = \"x*abs(x) - (x > 0.3)\"\n");
    let expressions = [
        "t",
        "-t^2 + 3*t",
        "t^3 - 1/(4 + t)",
        "t^-2",
        "(t + 4)^1.5",
        "2^t",
        "(t + 4)^t",
        "t/(t - 0.1)",
        "sin(5*t)",
        "cos(t^2)",
        "tan(t)",
        "asin(t/4)",
        "acos(t/4)",
        "atan(3*t)",
        "atan2(t, 1 - t^2)",
        "atan2(t - 1, t + 1)",
        "sinh(t)",
        "cosh(t)",
        "tanh(2*t)",
        "exp(-(t/0.1)^2)",
        "ln(t + 4)",
        "log10(t + 4)",
        "sqrt(t + 3.5)",
        "abs(sin(3*t))",
        "sign(t)",
        "floor(2*t)",
        "ceil(t^2)",
        "mod(t, 0.7)",
        "mod(t^2, 0.3)",
        "mod(-t, -1.1)",
        "min(t, t^2, 0.5)",
        "max(t, -t^3)",
        "step(0.2, t)",
        "t*(t < 0.4)",
        "t*(t >= 0.4)*(t != 1)",
        "if(sin(9*t) > 0.5 and t > 0, t, -t)",
        "if(t < 0 or t > 1, cos(t), 1)",
        "smoothstep(-0.3, 0.8, t)",
        "smoothstep(0, 1, t^2)*t",
        "linear_hold(t)",
        "linear_repeat(2*t)",
        "monotone_hold(t)",
        "monotone_repeat(t^2)",
        "g(g(t))",
        "g(linear_hold(t) - 1)",
        "floor(t) == 1",
        "1e6*(t == 0.25)*0",
        "1/(2*cosh(3*t)^2)",
    ];
    let mut random = Random(7);
    for expression in expressions {
        let function = function(expression, &more);
        for _ in 0..400 {
            let (middle, half) = (3.0 * random.signed(), 3.0 * 10_f64.powf(-3.0 * (1.0 + random.signed())));
            let interval = Range { low: (middle - half).max(-3.0), high: (middle + half).min(3.0) };
            let bounds = function.over(interval);
            let start = function.jet(interval.low);
            for share in [0.0, 0.5 + 0.5 * random.signed(), 0.5 + 0.5 * random.signed(), 1.0] {
                let t = (interval.low + share * (interval.high - interval.low)).clamp(interval.low, interval.high);
                let jet = function.jet(t);
                if jet.value.is_nan() || jet.second.is_nan() {
                    continue;
                }
                let what = format!("{expression} at {t} in {interval:?}: {jet:?}, {bounds:?}");
                assert!(holds(bounds.value, jet.value), "{what}");
                // At a corner itself the derivative is that of one side, or none.
                if share > 0.0 && share < 1.0 {
                    assert!(holds(bounds.first, jet.first) && holds(bounds.second, jet.second), "{what}");
                }
                // Without a switch the way from the start follows from the slope.
                if !bounds.switches && bounds.first.is_finite() && !start.value.is_nan() {
                    let most = bounds.first.largest() * (t - interval.low);
                    assert!((jet.value - start.value).abs() <= most + 1e-9 * (1.0 + jet.value.abs()), "{what}");
                }
            }
        }
    }
}
