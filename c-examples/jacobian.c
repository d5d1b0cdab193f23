/* How do the outputs at the end of a step depend on the inputs of the step? fmi2GetDirectionalDerivative knows from the step itself what
 * otherwise takes two more steps an input: back, the input changed, the step again. Here are both, side by side. A master that
 * repeats steps until two units agree (docs/coupling.md) needs this matrix.
 *
 * Build, in the directory that holds include/, lib/ and c-examples/, with model and header made first:
 *
 *     mkdir -p unit && cp c-examples/arm.toml unit/model.toml && ancf14 header c-examples/arm.toml --prefix ARM -o arm.h
 *     cc -std=c99 -Iinclude -I. c-examples/jacobian.c -Llib -lancf14 -Wl,-rpath,"$PWD/lib" -lm -o jacobian
 *
 * Run:
 *
 *     ./jacobian "$PWD/unit"
 */
#include <math.h>

#include "host.h"

enum { SIZE = 3, STEPS = 5 };

static const fmi2ValueReference forces[SIZE] = {ARM_push_force_1, ARM_push_force_2, ARM_push_force_3};
/* The place of the tip is the first three of `outputs`. */

/* The last step under `force`, N, from the state before it, and the outputs at its end. */
static void last_step(fmi2Component arm, fmi2FMUstate before, const double force[SIZE], double values[OUTPUTS]) {
    double time = (double)STEPS * ARM_STEP_SIZE;
    check(fmi2SetFMUstate(arm, before), "fmi2SetFMUstate");
    check(fmi2SetReal(arm, forces, SIZE, force), "fmi2SetReal");
    check(fmi2DoStep(arm, time, (double)(STEPS + 1) * ARM_STEP_SIZE - time, fmi2False), "fmi2DoStep");
    read_outputs(arm, values);
}

int main(int count, char **words) {
    const double force[SIZE] = {3.0, 1.0, -20.0}, difference = 1e-2, one = 1.0;
    double values[OUTPUTS], more[OUTPUTS], less[OUTPUTS];
    double derivative[SIZE], changed[SIZE], largest = 0.0, error = 0.0;
    fmi2FMUstate before = NULL, after = NULL;
    fmi2Component arm;
    int i, j;
    long k;

    if (count != 2) {
        fprintf(stderr, "usage: %s RESOURCES (the directory of model.toml)\n", words[0]);
        return EXIT_FAILURE;
    }

    arm = instantiate("arm", words[1]);
    initialize(arm);
    for (k = 0; k < STEPS; k++) {
        step(arm, k, -20.0);
    }
    check(fmi2GetFMUstate(arm, &before), "fmi2GetFMUstate");
    last_step(arm, before, force, values);
    check(fmi2GetFMUstate(arm, &after), "fmi2GetFMUstate");

    printf("force,place,by the unit,by differences\n");
    for (j = 0; j < SIZE; j++) {
        /* Of all places by force j, of the step just done: that is the step from `before` to `after`. */
        check(fmi2SetFMUstate(arm, after), "fmi2SetFMUstate");
        check(fmi2GetDirectionalDerivative(arm, outputs, SIZE, &forces[j], 1, &one, derivative),
              "fmi2GetDirectionalDerivative");

        for (i = 0; i < SIZE; i++) {
            changed[i] = force[i];
        }
        changed[j] = force[j] + difference;
        last_step(arm, before, changed, more);
        changed[j] = force[j] - difference;
        last_step(arm, before, changed, less);
        for (i = 0; i < SIZE; i++) {
            double by_differences = (more[i] - less[i]) / (2.0 * difference);
            printf("%d,%d,%.6e,%.6e\n", j + 1, i + 1, derivative[i], by_differences);
            largest = fmax(largest, fabs(derivative[i]));
            error = fmax(error, fabs(derivative[i] - by_differences));
        }
    }

    check(fmi2FreeFMUstate(arm, &before), "fmi2FreeFMUstate");
    check(fmi2FreeFMUstate(arm, &after), "fmi2FreeFMUstate");
    check(fmi2Terminate(arm), "fmi2Terminate");
    fmi2FreeInstance(arm);

    /* Differences of places of 1 m, rounded to 1e-16, over 2e-2 N are good to 1e-14 m/N: some 1e-8 of the largest derivative. What the
     * step itself leaves of its equations is smaller. */
    if (!(error < 1e-6 * largest)) {
        fprintf(stderr, "the derivatives differ by %g, the largest is %g\n", error, largest);
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
