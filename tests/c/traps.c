/* Runs a unit twice: RESOURCES GUID STEP COUNT INPUT OUTPUT...
 *
 * First in the usual floating-point environment, then as in a host that looks for faults, where a division by zero, an
 * invalid operation or an overflow ends the program, and all rounds upward. Instantiates, initializes, takes COUNT
 * steps, asks for values and derivatives in Initialization Mode and after each step, saves and restores a state, and
 * ends the run. Both runs must have the same bits, and the environment of the host must stay. Prints nothing. INPUT is
 * a value reference, or -1.
 */
#define _GNU_SOURCE
#include <fenv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ancf14.h"

#define TRAPS (FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW)

static char **words;
static int word_count;
static double *values;
static int value_count;

static void check(fmi2Status status, const char *call)
{
    if (status != fmi2OK) {
        fprintf(stderr, "%s: status %d\n", call, (int)status);
        exit(1);
    }
}

static void record(fmi2Component unit)
{
    const long input = atol(words[5]);
    int k;
    for (k = 6; k < word_count; ++k) {
        const fmi2ValueReference output = (fmi2ValueReference)atol(words[k]);
        const fmi2ValueReference known = (fmi2ValueReference)input;
        const fmi2Integer order = 1;
        const double seed = 1.0;
        check(fmi2GetReal(unit, &output, 1, values + value_count++), "fmi2GetReal");
        check(fmi2GetRealOutputDerivatives(unit, &output, 1, &order, values + value_count++),
              "fmi2GetRealOutputDerivatives");
        if (input >= 0) {
            check(fmi2GetDirectionalDerivative(unit, &output, 1, &known, 1, &seed, values + value_count++),
                  "fmi2GetDirectionalDerivative");
        }
    }
}

static void save_and_restore(fmi2Component unit)
{
    fmi2FMUstate state = NULL, copy = NULL;
    size_t size = 0;
    char *bytes;
    check(fmi2GetFMUstate(unit, &state), "fmi2GetFMUstate");
    check(fmi2SerializedFMUstateSize(unit, state, &size), "fmi2SerializedFMUstateSize");
    bytes = malloc(size);
    check(fmi2SerializeFMUstate(unit, state, bytes, size), "fmi2SerializeFMUstate");
    check(fmi2DeSerializeFMUstate(unit, bytes, size, &copy), "fmi2DeSerializeFMUstate");
    check(fmi2SetFMUstate(unit, copy), "fmi2SetFMUstate");
    check(fmi2FreeFMUstate(unit, &state), "fmi2FreeFMUstate");
    check(fmi2FreeFMUstate(unit, &copy), "fmi2FreeFMUstate");
    free(bytes);
}

static void simulate(const double *times, int count)
{
    const fmi2CallbackFunctions callbacks = {NULL, NULL, NULL, NULL, NULL};
    int k;
    fmi2Component unit =
        fmi2Instantiate("unit", fmi2CoSimulation, words[2], words[1], &callbacks, fmi2False, fmi2False);
    if (unit == NULL) {
        fprintf(stderr, "no instance\n");
        exit(1);
    }
    value_count = 0;
    check(fmi2SetupExperiment(unit, fmi2False, 0.0, 0.0, fmi2False, 0.0), "fmi2SetupExperiment");
    check(fmi2EnterInitializationMode(unit), "fmi2EnterInitializationMode");
    record(unit);
    check(fmi2ExitInitializationMode(unit), "fmi2ExitInitializationMode");
    for (k = 0; k < count; ++k) {
        check(fmi2DoStep(unit, times[2 * k], times[2 * k + 1], fmi2True), "fmi2DoStep");
        record(unit);
        save_and_restore(unit);
    }
    check(fmi2Terminate(unit), "fmi2Terminate");
    check(fmi2Reset(unit), "fmi2Reset");
    fmi2FreeInstance(unit);
}

int main(int count, char **given)
{
    double step, *times, *usual;
    int steps, size, k;
    if (count < 7) {
        fprintf(stderr, "usage: traps RESOURCES GUID STEP COUNT INPUT OUTPUT...\n");
        return 1;
    }
    words = given;
    word_count = count;
    step = atof(words[3]);
    steps = atoi(words[4]);
    size = 3 * (count - 6) * (steps + 1);
    times = malloc(2 * (size_t)steps * sizeof(double));
    values = calloc((size_t)size, sizeof(double));
    usual = calloc((size_t)size, sizeof(double));
    for (k = 0; k < steps; ++k) {
        times[2 * k] = k * step;
        times[2 * k + 1] = step;
    }
    simulate(times, steps);
    memcpy(usual, values, (size_t)size * sizeof(double));
    if (feclearexcept(FE_ALL_EXCEPT) != 0 || feenableexcept(TRAPS) == -1 || fesetround(FE_UPWARD) != 0) {
        fprintf(stderr, "no traps\n");
        return 1;
    }
    simulate(times, steps);
    if (fegetexcept() != TRAPS || fegetround() != FE_UPWARD || fetestexcept(TRAPS) != 0) {
        fprintf(stderr, "the environment of the host has changed\n");
        return 1;
    }
    if (memcmp(usual, values, (size_t)size * sizeof(double)) != 0) {
        fprintf(stderr, "other bits\n");
        return 1;
    }
    free(times);
    free(values);
    free(usual);
    return 0;
}
