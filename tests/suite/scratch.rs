use ancf14::fmi::{Model, Value};
use ancf14::model::simulation::Simulation;
#[test]
fn scratch() {
    let text = std::fs::read_to_string("/tmp/p.toml").unwrap();
    let mut s = Simulation::load("p.toml", &text, &[]).unwrap();
    println!("{:?}", s.about());
    s.initialize(0.0).unwrap();
    let now = std::time::Instant::now();
    for k in 0..=200 {
        if k > 0 { s.advance(k as f64 * 0.01).unwrap(); }
        if k % 20 == 0 {
        for (i, v) in s.variables().iter().enumerate() { if v.name.starts_with("tip.pos") || v.name == "energy.total" || v.name.starts_with("stat") || v.name.starts_with("tip.rot") { let Value::Real(x) = s.value(i) else { print!("{:?} ", s.value(i)); continue }; print!("{x:.6} "); } }
        println!();}
    }
    println!("{:?}", now.elapsed());
}
