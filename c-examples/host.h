/* What the examples beside this file share: a logger, a check of every status, how an instance starts, and its outputs. */
#ifndef HOST_H
#define HOST_H

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "ancf14.h"
#include "arm.h"

/* All Real outputs of the model: arm.h repeats REFERENCE(...) for each of them. */
#define REFERENCE(reference, name, unit_label) reference,
static const fmi2ValueReference outputs[] = {ARM_REAL_OUTPUTS(REFERENCE)};
#undef REFERENCE
#define OUTPUTS (sizeof outputs / sizeof outputs[0])

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

/* Ends the program if a call failed; the library has logged why. A warning is no failure. */
static void check(fmi2Status status, const char *call) {
    if (status > fmi2Warning) {
        fprintf(stderr, "%s failed with status %d\n", call, (int)status);
        exit(EXIT_FAILURE);
    }
}

/* A new instance of the model in the directory `resources`, with a name for its log lines. */
static fmi2Component instantiate(const char *name, const char *resources) {
    /* The library copies what it needs of the callbacks. On failure it has logged why. */
    fmi2CallbackFunctions callbacks = {print_message, NULL, NULL, NULL, NULL};
    fmi2Component arm = fmi2Instantiate(name, fmi2CoSimulation, ARM_GUID, resources, &callbacks, fmi2False, fmi2False);
    if (arm == NULL) {
        exit(EXIT_FAILURE);
    }
    return arm;
}

/* From just instantiated to the first step, at t = 0. */
static void initialize(fmi2Component arm) {
    check(fmi2SetupExperiment(arm, fmi2False, 0.0, 0.0, fmi2False, 0.0), "fmi2SetupExperiment");
    check(fmi2EnterInitializationMode(arm), "fmi2EnterInitializationMode");
    check(fmi2ExitInitializationMode(arm), "fmi2ExitInitializationMode");
}

/* Communication step number `k`, under a force along z, N. Time is a multiple of the step, never a running sum. */
static void step(fmi2Component arm, long k, double force) {
    const fmi2ValueReference input = ARM_push_force_3;
    double time = (double)k * ARM_STEP_SIZE;
    check(fmi2SetReal(arm, &input, 1, &force), "fmi2SetReal");
    check(fmi2DoStep(arm, time, (double)(k + 1) * ARM_STEP_SIZE - time, fmi2False), "fmi2DoStep");
}

/* Reads all Real outputs. */
static void read_outputs(fmi2Component arm, double values[OUTPUTS]) {
    check(fmi2GetReal(arm, outputs, OUTPUTS, values), "fmi2GetReal");
}

#endif
