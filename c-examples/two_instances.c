/* Two instances of one model with different parameters, stepped in turns: neither knows of the other, each moves as it does
 * alone, to the last bit.
 *
 * Build, in the directory that holds include/, lib/ and c-examples/, with model and header made first:
 *
 *     mkdir -p unit && cp c-examples/arm.toml unit/model.toml && ancf14 header c-examples/arm.toml --prefix ARM -o arm.h
 *     cc -std=c99 -Iinclude -I. c-examples/two_instances.c -Llib -lancf14 -Wl,-rpath,"$PWD/lib" -o two_instances
 *
 * Run:
 *
 *     ./two_instances "$PWD/unit"
 */
#include <string.h>

#include "host.h"

enum { STEPS = 10 };

/* An arm whose section has this radius, m, in this many elements. */
static fmi2Component start(const char *name, const char *resources, double radius, int elements) {
    const fmi2ValueReference radius_of_rod = ARM_rod_radius, elements_of_arm = ARM_arm_elements;
    fmi2Component arm = instantiate(name, resources);
    check(fmi2SetReal(arm, &radius_of_rod, 1, &radius), "fmi2SetReal");
    check(fmi2SetInteger(arm, &elements_of_arm, 1, &elements), "fmi2SetInteger");
    initialize(arm);
    return arm;
}

static void finish(fmi2Component arm) {
    check(fmi2Terminate(arm), "fmi2Terminate");
    fmi2FreeInstance(arm);
}

int main(int count, char **words) {
    double of_thin[OUTPUTS], of_thick[OUTPUTS], alone[OUTPUTS];
    fmi2Component thin, thick;
    long k;

    if (count != 2) {
        fprintf(stderr, "usage: %s RESOURCES (the directory of model.toml)\n", words[0]);
        return EXIT_FAILURE;
    }

    thin = start("thin", words[1], 0.008, 4);
    thick = start("thick", words[1], 0.012, 2);
    printf("time,tip of the thin arm,tip of the thick arm\n");
    for (k = 0; k < STEPS; k++) {
        step(thin, k, 5.0);
        step(thick, k, -5.0);
        read_outputs(thin, of_thin);
        read_outputs(thick, of_thick);
        printf("%.17g,%.17g,%.17g\n", (double)(k + 1) * ARM_STEP_SIZE, of_thin[2], of_thick[2]);
    }
    finish(thin);
    finish(thick);

    /* The thick one again, alone. */
    thick = start("alone", words[1], 0.012, 2);
    for (k = 0; k < STEPS; k++) {
        step(thick, k, -5.0);
    }
    read_outputs(thick, alone);
    finish(thick);
    if (memcmp(of_thick, alone, sizeof alone) != 0) {
        fprintf(stderr, "the instances disturb each other\n");
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
