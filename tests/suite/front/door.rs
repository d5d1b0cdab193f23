//! Does `ancf14::Simulation` say what is wrong with a call, and what is odd about a model? That it computes what
//! `ancf14 run` computes is tested with the command line.

use ancf14::{Error, Kind, Simulation};

/// A clamped arm whose end can be pushed.
const ARM: &str = include_str!("../../../c-examples/arm.toml");

fn arm() -> Simulation {
    Simulation::from_text("arm.toml", ARM).unwrap()
}

/// Warnings about the file and about many rejected steps are told too, as by the command.
#[test]
fn the_file_and_the_effort_are_warned_of() {
    let soft = ARM.replace("young = 2.1e11", "young = 2.1e5");
    let mut simulation = Simulation::from_text("arm.toml", &soft).unwrap();
    let warnings = simulation.take_warnings();
    assert!(warnings.len() == 1 && warnings[0].contains("young"), "{warnings:?}");
    let fast =
        ARM.replace("force = [0, 0, 0]\ninput = true", "force = [0, 0, \"3e4*sin(3e3*t)\"]").replace("2e-3", "1e-2");
    let mut simulation = Simulation::from_text("arm.toml", &fast).unwrap();
    simulation.run(|_| Ok(())).unwrap();
    let warnings = simulation.take_warnings();
    assert!(warnings.iter().any(|warning| warning.contains("steps were rejected")), "{warnings:?}");
}

/// A saved state goes on with the same bits, and so does a run after a reset.
#[test]
fn runs_repeat() {
    let mut simulation = arm();
    simulation.set("rod.radius", 0.02).unwrap();
    simulation.initialize().unwrap();
    simulation.advance(0.02).unwrap();
    let saved = simulation.save().unwrap();
    let go_on = |simulation: &mut Simulation| {
        simulation.set("push.force[3]", 5.0).unwrap();
        simulation.advance(0.05).unwrap();
        simulation.value("tip.position[3]").unwrap()
    };
    let first = go_on(&mut simulation);
    simulation.restore(&saved).unwrap();
    assert_eq!((simulation.time(), simulation.value("push.force[3]")), (0.02, Ok(0.0)));
    assert_eq!(go_on(&mut simulation), first);
    simulation.reset().unwrap();
    assert_eq!((simulation.time(), simulation.value("rod.radius")), (0.0, Ok(0.01)));
    simulation.set("rod.radius", 0.02).unwrap();
    simulation.initialize().unwrap();
    simulation.advance(0.02).unwrap();
    assert_eq!(go_on(&mut simulation), first);
}

/// The bytes of a saved state go on with the same bits in another simulation of the model; damaged bytes, and those of
/// another model, are refused.
#[test]
fn states_are_bytes() {
    let mut simulation = arm();
    simulation.initialize().unwrap();
    simulation.advance(0.02).unwrap();
    let mut bytes = simulation.write_state(&simulation.save().unwrap()).unwrap();
    let mut other = arm();
    other.restore(&other.read_state(&bytes).unwrap()).unwrap();
    for simulation in [&mut simulation, &mut other] {
        simulation.advance(0.05).unwrap();
    }
    let tip =
        |simulation: &Simulation| [1, 2, 3].map(|axis| simulation.value(&format!("tip.position[{axis}]")).unwrap());
    assert_eq!((tip(&simulation), simulation.time()), (tip(&other), 0.05));
    let foreign = Simulation::from_text_with("a", ARM, &[("arm.elements", "2")]).unwrap();
    assert!(matches!(foreign.read_state(&bytes), Err(Error::ForeignState)));
    *bytes.last_mut().unwrap() ^= 1;
    assert!(simulation.read_state(&bytes).is_err());
}

/// A run that its callback stops has the rows so far, and goes on where it stands.
#[test]
fn the_callback_stops_a_run() {
    let mut simulation = arm();
    let mut rows = Vec::new();
    let mut until = |most: usize, simulation: &mut Simulation| {
        simulation
            .run_while(|simulation| {
                rows.push(simulation.time());
                Ok(rows.len() < most)
            })
            .unwrap();
        rows.clone()
    };
    let first = until(4, &mut simulation);
    assert_eq!((first.len(), simulation.time()), (4, first[3]));
    let rows = until(usize::MAX, &mut simulation);
    // The row where it stands is looked at again.
    assert_eq!((rows[4], rows.last()), (first[3], Some(&simulation.stop_time())));
}

/// An error of the file knows its line; an error of an override has none.
#[test]
fn mistakes_know_their_line() {
    let line = |text: &str, overrides: &[(&str, &str)]| match Simulation::from_text_with("a", text, overrides) {
        Err(Error::Mistakes { line, .. }) => line,
        _ => panic!("there is a mistake"),
    };
    assert_eq!(line("format = 1\n\nmodel = 3\n", &[]), Some(3));
    assert_eq!(line(ARM, &[("arm.elements", "-1")]), None);
}

/// Inputs that the callback sets act; its error ends the run where it stands; a run goes on from the time reached.
#[test]
fn the_callback_is_in_the_loop() {
    let run = |force: f64| {
        let mut simulation = arm();
        let push = simulation.find("push.force[3]").unwrap();
        let mut times = Vec::new();
        simulation
            .run(|arm| {
                times.push(arm.time());
                arm.set_value_of(push, force)
            })
            .unwrap();
        assert_eq!(times.len(), 11, "{times:?}");
        simulation.value("tip.position[3]").unwrap()
    };
    assert!(run(100.0) > run(0.0) + 1e-4);

    let mut simulation = arm();
    let mut calls = 0;
    let outcome = simulation.run(|arm| {
        calls += 1;
        if calls == 3 { arm.value("nobody").map(|_| ()) } else { Ok(()) }
    });
    assert!(matches!(outcome, Err(Error::UnknownVariable { .. })));
    assert_eq!(simulation.time(), 0.02);
    let rest = simulation.record(&["tip.position[3]"]).unwrap();
    assert_eq!((rest.time().len(), rest.time()[0], rest.time()[8]), (9, 0.02, 0.1));
}

/// Names, kinds, units and bounds.
#[test]
fn variables_are_described() {
    let simulation = arm();
    assert_eq!((simulation.name(), simulation.stop_time(), simulation.output_step()), ("Arm", 0.1, 1e-2));
    for (name, unit, kind) in [
        ("rod.radius", "m", Kind::Parameter),
        ("gravity[3]", "m/s2", Kind::Tunable),
        ("push.force[1]", "N", Kind::Input),
        ("tip.velocity[2]", "m/s", Kind::Output),
    ] {
        let id = simulation.find(name).unwrap();
        let variable = simulation.variable(id.index()).unwrap();
        assert_eq!((variable.id, variable.name, variable.unit, variable.kind), (id, name, unit, kind));
        assert!(variable.description.len() > 5, "{name}");
    }
    assert_eq!(simulation.variables().filter(|variable| variable.kind == Kind::Input).count(), 6, "force and moment");
    assert_eq!(simulation.variable(0).unwrap(), simulation.variables().next().unwrap());
}

/// Each mistake is an error of its own type.
#[test]
fn mistakes_have_types() {
    assert!(matches!(Simulation::open("missing.toml"), Err(Error::Unreadable { .. })));
    assert!(matches!(Simulation::from_text("a", "format = 2"), Err(Error::Mistakes { .. })));
    assert!(matches!(Simulation::from_text_with("a", ARM, &[("no.thing", "1")]), Err(Error::Mistakes { .. })));
    let mut simulation = arm();
    assert_eq!(simulation.advance(0.1), Err(Error::NotInitialized));
    assert_eq!(simulation.finish(), Err(Error::NotInitialized));
    assert_eq!(simulation.value("tip.position[3]"), Err(Error::NotInitialized));
    assert_eq!(simulation.modes(1).unwrap_err(), Error::NotInitialized);
    assert_eq!(simulation.value("rod.radius"), Ok(0.01));
    assert!(matches!(simulation.variable(9999), Err(Error::UnknownIndex { index: 9999, .. })));
    for (name, value) in
        [("tip.position[3]", 1.0), ("rod.radius", -1.0), ("rod.radius", f64::NAN), ("arm.elements", 2.5)]
    {
        assert!(matches!(simulation.set(name, value), Err(Error::Refused { .. })), "{name} {value}");
    }
    // Nothing moves where the parameters make no mechanism; others can be tried.
    simulation.set("rod.radius", 1e-300).unwrap();
    assert!(matches!(simulation.initialize(), Err(Error::Failed { .. })), "a rod without stiffness");
    assert_eq!(simulation.value("tip.position[3]"), Err(Error::NotInitialized));
    simulation.set("rod.radius", 0.01).unwrap();
    simulation.initialize().unwrap();
    assert_eq!(simulation.initialize(), Err(Error::Initialized));
    assert!(matches!(simulation.set("rod.radius", 0.02), Err(Error::Refused { .. })));
    simulation.advance(0.01).unwrap();
    assert_eq!(simulation.advance(0.0), Err(Error::Time { from: 0.01, to: 0.0 }));
    simulation.advance(0.01).unwrap();
    let saved = Simulation::from_text_with("a", ARM, &[("arm.elements", "2")]).unwrap().save().unwrap();
    assert_eq!(simulation.restore(&saved), Err(Error::ForeignState));
    simulation.set("push.force[3]", 1e300).unwrap();
    assert!(matches!(simulation.advance(0.02), Err(Error::Failed { .. })));
    assert_eq!(simulation.advance(0.02), Err(Error::Stopped { time: 0.01 }));
    simulation.reset().unwrap();
    simulation.run(|_| Ok(())).unwrap();
    assert_eq!(simulation.advance(0.2), Err(Error::Finished { time: 0.1 }));
    let many = [("simulation.output_step", "1e-12")];
    let mut endless = Simulation::from_text_with("a", ARM, &many).unwrap();
    assert!(matches!(endless.record(&[]), Err(Error::TooManyRows { .. })));
}

/// Sentences name what a Rust programmer can call, no function of FMI.
#[test]
fn sentences_are_for_programs() {
    let errors = [
        Error::NotInitialized,
        Error::Initialized,
        Error::Finished { time: 0.1 + 0.2 },
        Error::Stopped { time: 0.5 },
        Error::ForeignState,
        arm().find("tip.positon[3]").unwrap_err(),
    ];
    let sentences = errors.map(|error| error.to_string());
    assert!(sentences.iter().all(|sentence| !sentence.contains("fmi")), "{sentences:?}");
    assert!(sentences[2].contains("t = 0.3 s"), "{}", sentences[2]);
    assert!(sentences[5].contains("did you mean `tip.position[3]`?"), "{}", sentences[5]);
    // A `main` that returns an error prints it readably.
    let mistakes = Simulation::from_text("arm.toml", "format = 2").unwrap_err();
    assert_eq!(format!("{mistakes:?}"), mistakes.to_string());
    let mut simulation = arm();
    simulation.initialize().unwrap();
    let fixed = simulation.set("rod.radius", 0.02).unwrap_err().to_string();
    assert!(fixed.contains("rod.radius is fixed") && !fixed.contains("fmi"), "{fixed}");
}
