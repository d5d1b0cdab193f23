/* Steps many instances with different forces, first one after another, then by several threads at once, then in a forked process that goes
 * on with instances of its parent: the numbers agree to the last bit.
 *
 *     threads RESOURCES GUID FORCE OUTPUT
 *
 * FORCE and OUTPUT are value references of an input and an output. */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "ancf14.h"

enum { INSTANCES = 64, THREADS = 8, STEPS = 20 };

typedef struct {
    fmi2Component unit;
    double force;
    double values[STEPS];
} Run;

static char **words;

static void logger(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
                   fmi2String message, ...) {
    (void)environment, (void)instance, (void)status, (void)category;
    fprintf(stderr, "%s\n", message);
}

static void check(int right, const char *what) {
    if (!right) {
        fprintf(stderr, "%s failed\n", what);
        exit(EXIT_FAILURE);
    }
}

static void start(Run *run, int number) {
    fmi2CallbackFunctions callbacks = {logger, NULL, NULL, NULL, NULL};
    run->force = 0.5 * number;
    run->unit = fmi2Instantiate("unit", fmi2CoSimulation, words[2], words[1], &callbacks, fmi2False, fmi2False);
    check(run->unit != NULL, "fmi2Instantiate");
    check(fmi2EnterInitializationMode(run->unit) == fmi2OK, "fmi2EnterInitializationMode");
    check(fmi2ExitInitializationMode(run->unit) == fmi2OK, "fmi2ExitInitializationMode");
}

static void step(Run *run, int from, int to) {
    const fmi2ValueReference force = (fmi2ValueReference)atoi(words[3]), output = (fmi2ValueReference)atoi(words[4]);
    int k;
    for (k = from; k < to; k++) {
        double now = run->force * k;
        check(fmi2SetReal(run->unit, &force, 1, &now) == fmi2OK, "fmi2SetReal");
        check(fmi2DoStep(run->unit, 1e-3 * k, 1e-3 * (k + 1) - 1e-3 * k, fmi2True) == fmi2OK, "fmi2DoStep");
        check(fmi2GetReal(run->unit, &output, 1, &run->values[k]) == fmi2OK, "fmi2GetReal");
    }
}

/* Every eighth instance, a step of each at a time, from making to freeing. */
static void *work(void *first) {
    Run *runs = first;
    int number, k;
    for (k = 0; k < STEPS; k++) {
        for (number = 0; number < INSTANCES; number += THREADS) {
            step(&runs[number], k, k + 1);
        }
    }
    for (number = 0; number < INSTANCES; number += THREADS) {
        fmi2FreeInstance(runs[number].unit);
    }
    return NULL;
}

static void agree(const Run *some, const Run *others, const char *what) {
    int number;
    for (number = 0; number < INSTANCES; number++) {
        check(memcmp(some[number].values, others[number].values, sizeof others[number].values) == 0, what);
    }
    check(some[0].values[STEPS - 1] != some[1].values[STEPS - 1], "different forces, different motions:");
}

int main(int count, char **arguments) {
    static Run alone[INSTANCES], together[INSTANCES], forked[INSTANCES];
    pthread_t threads[THREADS];
    int number, status;
    pid_t child;

    words = arguments;
    check(count == 5, "RESOURCES GUID FORCE OUTPUT");
    for (number = 0; number < INSTANCES; number++) {
        start(&alone[number], number);
        step(&alone[number], 0, STEPS);
        fmi2FreeInstance(alone[number].unit);
    }

    for (number = 0; number < INSTANCES; number++) {
        start(&together[number], number);
    }
    for (number = 0; number < THREADS; number++) {
        check(pthread_create(&threads[number], NULL, work, &together[number]) == 0, "pthread_create");
    }
    for (number = 0; number < THREADS; number++) {
        check(pthread_join(threads[number], NULL) == 0, "pthread_join");
    }
    agree(alone, together, "the threads' bits:");

    for (number = 0; number < INSTANCES; number++) {
        start(&forked[number], number);
        step(&forked[number], 0, STEPS / 2);
    }
    child = fork();
    check(child >= 0, "fork");
    for (number = 0; number < INSTANCES; number++) {
        step(&forked[number], STEPS / 2, STEPS);
        fmi2FreeInstance(forked[number].unit);
    }
    agree(alone, forked, child == 0 ? "the child's bits:" : "the parent's bits:");
    if (child == 0) {
        return EXIT_SUCCESS;
    }
    check(waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0, "the child");
    return EXIT_SUCCESS;
}
