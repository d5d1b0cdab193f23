/* FMI 3.0: when does the tip of a falling arm pass a height? The host hears of every internal step of the unit, reads the tip there, and
 * ends the communication step at the first one below the height. fmi3DoStep returns early, and the next step begins at that time.
 *
 * Build, in the directory that holds include/, lib/ and c-examples/, with model and header made first:
 *
 *     mkdir -p unit && cp c-examples/arm.toml unit/model.toml && ancf14 header c-examples/arm.toml --prefix ARM -o arm.h
 *     cc -std=c99 -Ic-examples/fmi3 -I. c-examples/simulate_fmi3.c -Llib -lancf14 -Wl,-rpath,"$PWD/lib" -o simulate_fmi3
 *
 * Run:
 *
 *     ./simulate_fmi3 "$PWD/unit/"
 *
 * The value reference of an array is that of its first element: arm.h, made for FMI 2.0, has it too. c-examples/fmi3 holds the standard's
 * own headers.
 */
#include <stdio.h>
#include <stdlib.h>

#include "arm.h"
#include "fmi3Functions.h"

enum { SIZE = 3, STEPS = 5 };

/* The height of the tip that the host waits for, m. */
static const double HEIGHT = -1e-3;

/* What the callbacks know of the simulation. */
typedef struct {
    fmi3Instance arm;
    int updates;
    int passed;
} Host;

static void print_message(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                          fmi3String message) {
    (void)environment;
    (void)status;
    fprintf(stderr, "[%s] %s\n", category, message);
}

/* Ends the program if a call failed; the library has logged why. A warning is no failure. */
static void check(fmi3Status status, const char *call) {
    if (status > fmi3Warning) {
        fprintf(stderr, "%s failed with status %d\n", call, (int)status);
        exit(EXIT_FAILURE);
    }
}

static void read_tip(fmi3Instance arm, double place[SIZE]) {
    const fmi3ValueReference tip = ARM_tip_position_1;
    check(fmi3GetFloat64(arm, &tip, 1, place, SIZE), "fmi3GetFloat64");
}

/* Called by the unit after each of its internal steps. */
static void update(fmi3InstanceEnvironment environment, fmi3Float64 time, fmi3Boolean set_requested,
                   fmi3Boolean get_allowed, fmi3Boolean finished, fmi3Boolean can_return, fmi3Boolean *return_requested,
                   fmi3Float64 *return_time) {
    Host *host = environment;
    double place[SIZE];
    (void)set_requested;
    host->updates++;
    if (!get_allowed || !finished) {
        return;
    }
    read_tip(host->arm, place);
    if (!host->passed && place[2] < HEIGHT) {
        host->passed = 1;
        if (can_return) {
            *return_requested = fmi3True;
            *return_time = time;
        }
    }
}

static void print_row(fmi3Instance arm, double time, fmi3Boolean early) {
    double place[SIZE];
    read_tip(arm, place);
    printf("%.17g,%d,%.17g\n", time, (int)early, place[2]);
}

int main(int count, char **words) {
    const fmi3ValueReference tip = ARM_tip_position_1;
    Host host = {NULL, 0, 0};
    double time = 0.0;
    long k = 1;

    if (count != 2) {
        fprintf(stderr, "usage: %s RESOURCES (the directory of model.toml, with a slash at its end)\n", words[0]);
        return EXIT_FAILURE;
    }

    /* Early returns are allowed, and the tip is read between communication points. On failure the library has logged why. */
    host.arm = fmi3InstantiateCoSimulation("arm", ARM_GUID, words[1], fmi3False, fmi3False, fmi3False, fmi3True, &tip, 1,
                                           &host, print_message, update);
    if (host.arm == NULL) {
        return EXIT_FAILURE;
    }
    check(fmi3EnterInitializationMode(host.arm, fmi3False, 0.0, 0.0, fmi3False, 0.0), "fmi3EnterInitializationMode");
    check(fmi3ExitInitializationMode(host.arm), "fmi3ExitInitializationMode");

    printf("time,early,height of the tip\n");
    print_row(host.arm, time, fmi3False);
    while (k <= STEPS) {
        fmi3Boolean event, end, early;
        double next = (double)k * ARM_STEP_SIZE;
        check(fmi3DoStep(host.arm, time, next - time, fmi3True, &event, &end, &early, &time), "fmi3DoStep");
        print_row(host.arm, time, early);
        if (!early) {
            k++;
        }
    }
    check(fmi3Terminate(host.arm), "fmi3Terminate");
    fmi3FreeInstance(host.arm);
    if (!host.passed || host.updates < STEPS) {
        fprintf(stderr, "the tip never passed %g m\n", HEIGHT);
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
