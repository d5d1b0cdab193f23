/* Runs a unit in a thread with a small stack: RESOURCES GUID KIBIBYTES STEP INPUT OUTPUT...
 *
 * Instantiates, initializes, takes three steps, asks for derivatives, and saves, serializes and restores a state. Prints nothing; a
 * stack that is too small ends it by a signal. INPUT is a value reference, or -1.
 */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

#include "ancf14.h"

static char **arguments;
static int argument_count;

static void check(fmi2Status status, const char *what)
{
    if (status != fmi2OK) {
        fprintf(stderr, "%s: status %d\n", what, (int)status);
        exit(1);
    }
}

static void *simulate(void *nothing)
{
    const fmi2CallbackFunctions callbacks = {NULL, NULL, NULL, NULL, NULL};
    const double step = atof(arguments[4]);
    const long input = atol(arguments[5]);
    fmi2FMUstate state = NULL, copy = NULL;
    size_t size = 0;
    char *bytes;
    int k;
    fmi2Component unit =
        fmi2Instantiate("unit", fmi2CoSimulation, arguments[2], arguments[1], &callbacks, fmi2False, fmi2False);
    (void)nothing;
    if (unit == NULL) {
        fprintf(stderr, "no instance\n");
        exit(1);
    }
    check(fmi2SetupExperiment(unit, fmi2False, 0.0, 0.0, fmi2False, 0.0), "setup");
    check(fmi2EnterInitializationMode(unit), "enter");
    check(fmi2ExitInitializationMode(unit), "exit");
    for (k = 0; k < 3; ++k) {
        check(fmi2DoStep(unit, k * step, step, fmi2True), "step");
    }
    for (k = 6; k < argument_count; ++k) {
        const fmi2ValueReference output = (fmi2ValueReference)atol(arguments[k]);
        const fmi2ValueReference known = (fmi2ValueReference)input;
        const fmi2Integer order = 1;
        const double seed = 1.0;
        double value = 0.0;
        check(fmi2GetRealOutputDerivatives(unit, &output, 1, &order, &value), "output derivatives");
        if (input >= 0) {
            check(fmi2GetDirectionalDerivative(unit, &output, 1, &known, 1, &seed, &value), "directional derivative");
        }
    }
    check(fmi2GetFMUstate(unit, &state), "state");
    check(fmi2SerializedFMUstateSize(unit, state, &size), "size");
    bytes = malloc(size);
    check(fmi2SerializeFMUstate(unit, state, bytes, size), "bytes");
    check(fmi2DeSerializeFMUstate(unit, bytes, size, &copy), "state of bytes");
    check(fmi2SetFMUstate(unit, copy), "restore");
    check(fmi2DoStep(unit, 3 * step, step, fmi2True), "step after restore");
    check(fmi2Reset(unit), "reset");
    check(fmi2FreeFMUstate(unit, &state), "free state");
    check(fmi2FreeFMUstate(unit, &copy), "free copy");
    fmi2FreeInstance(unit);
    free(bytes);
    return NULL;
}

int main(int count, char **values)
{
    pthread_attr_t attributes;
    pthread_t thread;
    if (count < 7) {
        fprintf(stderr, "usage: small_stack RESOURCES GUID KIBIBYTES STEP INPUT OUTPUT...\n");
        return 1;
    }
    arguments = values;
    argument_count = count;
    if (pthread_attr_init(&attributes) != 0
        || pthread_attr_setstacksize(&attributes, (size_t)atol(values[3]) * 1024) != 0
        || pthread_create(&thread, &attributes, simulate, NULL) != 0 || pthread_join(thread, NULL) != 0) {
        fprintf(stderr, "no thread\n");
        return 1;
    }
    return 0;
}
