/* Runs a packed model through the plain C functions and prints all its outputs as a table.
 *
 * Build, in the directory that holds include/ and lib/:
 *
 *     ancf14 pack model.toml -o model.fmu && unzip -q model.fmu -d unit
 *     ancf14 header model.toml --prefix MODEL -o model.h
 *     cc -std=c99 -Iinclude -I. c-examples/simulate_fmi2.c -Llib -lancf14 -Wl,-rpath,"$PWD/lib" -o simulate_fmi2
 *
 * Run:
 *
 *     ./simulate_fmi2 "$PWD/unit/resources"
 *
 * The library reads model.toml in the directory given. model.h, made from the same file, holds the GUID, names for the
 * value references, and the lists of outputs used here. Instead of ancf14.h the standard's fmi2Functions.h will do.
 */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "ancf14.h"
#include "model.h"

/* Takes the log lines. The message is a printf format; this library passes no further arguments, others may. */
static void print_message(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                          fmi2String category, fmi2String message, ...) {
    va_list arguments;
    (void)environment;
    (void)status;
    fprintf(stderr, "%s [%s] ", instance, category);
    va_start(arguments, message);
    vfprintf(stderr, message, arguments);
    va_end(arguments);
    fputc('\n', stderr);
}

/* Ends the program if a call failed; the reason has been logged. A warning is none. */
static void check(fmi2Component unit, fmi2Status status, const char *call) {
    if (status > fmi2Warning) {
        fprintf(stderr, "%s failed with status %d\n", call, (int)status);
        fmi2FreeInstance(unit);
        exit(EXIT_FAILURE);
    }
}

/* One cell of the table. */
static void print_real(fmi2Component unit, fmi2ValueReference reference) {
    fmi2Real value;
    check(unit, fmi2GetReal(unit, &reference, 1, &value), "fmi2GetReal");
    printf(",%.17g", value);
}

static void print_integer(fmi2Component unit, fmi2ValueReference reference) {
    fmi2Integer value;
    check(unit, fmi2GetInteger(unit, &reference, 1, &value), "fmi2GetInteger");
    printf(",%d", value);
}

/* One row of the table. model.h repeats CELL(...) for every output. */
static void print_row(fmi2Component unit, double time) {
    printf("%.17g", time);
#define CELL(reference, name, unit_label) print_real(unit, reference);
    MODEL_REAL_OUTPUTS(CELL)
#undef CELL
#define CELL(reference, name, unit_label) print_integer(unit, reference);
    (void)print_integer; /* a model without totals has no integers */
    MODEL_INTEGER_OUTPUTS(CELL)
#undef CELL
    printf("\n");
}

int main(int count, char **words) {
    fmi2CallbackFunctions callbacks = {print_message, NULL, NULL, NULL, NULL};
    fmi2Component unit;
    long steps, k;

    if (count != 2) {
        fprintf(stderr, "usage: %s RESOURCES (the `resources` directory of an unpacked FMU)\n", words[0]);
        return EXIT_FAILURE;
    }

    /* The library copies what it needs of the callbacks. On failure it has logged why. */
    unit = fmi2Instantiate("simulate", fmi2CoSimulation, MODEL_GUID, words[1], &callbacks, fmi2False, fmi2False);
    if (unit == NULL) {
        return EXIT_FAILURE;
    }

    /* From t = 0, without a stop time. Parameters would be set here, with fmi2SetReal. */
    check(unit, fmi2SetupExperiment(unit, fmi2False, 0.0, 0.0, fmi2False, 0.0), "fmi2SetupExperiment");
    check(unit, fmi2EnterInitializationMode(unit), "fmi2EnterInitializationMode");
    check(unit, fmi2ExitInitializationMode(unit), "fmi2ExitInitializationMode");

    printf("time");
#define CELL(reference, name, unit_label) printf(",\"%s\"", name); /* a matrix's names have a comma */
    MODEL_REAL_OUTPUTS(CELL)
    MODEL_INTEGER_OUTPUTS(CELL)
#undef CELL
    printf("\n");
    print_row(unit, 0.0);

    /* Time is a multiple of the step, never a running sum. Inputs would be set before each step. */
    steps = (long)(MODEL_STOP_TIME / MODEL_STEP_SIZE + 0.5);
    for (k = 0; k < steps; k++) {
        double time = (double)k * MODEL_STEP_SIZE;
        double next = (double)(k + 1) * MODEL_STEP_SIZE;
        check(unit, fmi2DoStep(unit, time, next - time, fmi2True), "fmi2DoStep");
        print_row(unit, next);
    }

    check(unit, fmi2Terminate(unit), "fmi2Terminate");
    fmi2FreeInstance(unit);
    return EXIT_SUCCESS;
}
