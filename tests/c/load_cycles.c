/* Loads the library, makes an instance, steps it, frees it and unloads the library, again and again: is the memory of the process after
 * many cycles what it was after few?
 *
 *     load_cycles LIBRARY RESOURCES GUID FEW MANY
 *
 * prints the resident memory in KiB after the few and after the many cycles. */
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ancf14.h"

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

/* ISO C has no cast from a pointer to an object, which dlsym gives, to one to a function. */
static void find(void *library, const char *name, void *function) {
    void *address = dlsym(library, name);
    check(address != NULL, name);
    memcpy(function, &address, sizeof address);
}

static void cycle(char **words) {
    fmi2CallbackFunctions callbacks = {logger, NULL, NULL, NULL, NULL};
    fmi2Component (*instantiate)(fmi2String, fmi2Type, fmi2String, fmi2String, const fmi2CallbackFunctions *,
                                 fmi2Boolean, fmi2Boolean);
    fmi2Status (*enter)(fmi2Component), (*leave)(fmi2Component);
    fmi2Status (*do_step)(fmi2Component, fmi2Real, fmi2Real, fmi2Boolean);
    void (*free_instance)(fmi2Component);
    fmi2Component unit;
    void *library = dlopen(words[1], RTLD_NOW | RTLD_LOCAL);

    check(library != NULL, "dlopen");
    find(library, "fmi2Instantiate", &instantiate);
    find(library, "fmi2EnterInitializationMode", &enter);
    find(library, "fmi2ExitInitializationMode", &leave);
    find(library, "fmi2DoStep", &do_step);
    find(library, "fmi2FreeInstance", &free_instance);
    unit = instantiate("cycle", fmi2CoSimulation, words[3], words[2], &callbacks, fmi2False, fmi2False);
    check(unit != NULL, "fmi2Instantiate");
    check(enter(unit) == fmi2OK && leave(unit) == fmi2OK, "the initialization");
    check(do_step(unit, 0.0, 1e-3, fmi2True) == fmi2OK, "fmi2DoStep");
    free_instance(unit);
    check(dlclose(library) == 0, "dlclose");
    check(dlopen(words[1], RTLD_NOW | RTLD_NOLOAD) == NULL, "unloading");
}

/* KiB of the process that are in memory. */
static long resident(void) {
    char line[200];
    long kib = -1;
    FILE *file = fopen("/proc/self/status", "r");
    check(file != NULL, "/proc/self/status");
    while (fgets(line, sizeof line, file) != NULL) {
        if (strncmp(line, "VmRSS:", 6) == 0) {
            kib = strtol(line + 6, NULL, 10);
        }
    }
    fclose(file);
    return kib;
}

int main(int count, char **words) {
    long few, many, k;

    check(count == 6, "LIBRARY RESOURCES GUID FEW MANY");
    few = strtol(words[4], NULL, 10);
    many = strtol(words[5], NULL, 10);
    for (k = 1; k <= many; k++) {
        cycle(words);
        if (k == few || k == many) {
            printf("%ld\n", resident());
        }
    }
    return EXIT_SUCCESS;
}
