/* Value references of the model Toy & "friends", made by ancf14 0.1.0. */
#ifndef TOY_MODEL_H
#define TOY_MODEL_H

/* What fmi2Instantiate compares with the model file. */
#define Toy_GUID "{00000000-0000-0000-0000-000000000001}"
#define Toy_MODEL_IDENTIFIER "Toy"

/* Default stop time and communication step, s. */
#define Toy_STOP_TIME 2.0
#define Toy_STEP_SIZE 0.1

enum Toy_variable {
    /* gain: parameter, Real, m/(N.s). The gain of the toy */
    Toy_gain = 0,
    /* body.length: parameter, Real, m. The body.length of the toy */
    Toy_body_length = 1,
    /* tip.force[1]: input, Real, N. The tip.force[1] of the toy */
    Toy_tip_force_1 = 2,
    /* area: calculatedParameter, Real, m2. The area of the toy */
    Toy_area = 3,
    /* tip.position[1]: output, Real, m. The tip.position[1] of the toy */
    Toy_tip_position_1 = 4,
    /* statistics.steps: output, Integer. The statistics.steps of the toy */
    Toy_statistics_steps = 5,
    /* body.cells: parameter, Integer. The body.cells of the toy */
    Toy_body_cells = 6,
    /* time: independent, Real, s. The time of the toy */
    Toy_time = 7
};

/* X(value reference, name, unit) for each of them, in the order of the description. */
#define Toy_REAL_OUTPUTS(X) \
    X(Toy_tip_position_1, "tip.position[1]", "m")

/* X(value reference, name, unit) for each of them, in the order of the description. */
#define Toy_INTEGER_OUTPUTS(X) \
    X(Toy_statistics_steps, "statistics.steps", "")

/* X(value reference, name, unit, rows, columns) for each of them in FMI 3.0; of a vector there is one column. */
#define Toy_FLOAT64_OUTPUTS(X) \
    X(Toy_tip_position_1, "tip.position", "m", 1, 1)

#endif
