/* Runs a model file and prints its first outputs as a table. */
#include <stdio.h>
#include <stdlib.h>

#include "ancf14.h"

enum { COLUMNS = 3 };

/* Ends the program if a call failed. */
static void check(ancf14_simulation *simulation, ancf14_status status) {
    if (status != ANCF14_OK) {
        fprintf(stderr, "%s\n", ancf14_last_error(simulation));
        ancf14_free(simulation);
        exit(EXIT_FAILURE);
    }
}

int main(int count, char **words) {
    char error[4096] = "usage: simulate MODEL.toml";
    ancf14_simulation *simulation = count == 2 ? ancf14_load_file(words[1], NULL, error, sizeof error) : NULL;
    int outputs[COLUMNS], found = 0, variable;
    const char *warning;
    long row, rows;

    if (simulation == NULL) {
        fprintf(stderr, "%s\n", error);
        return EXIT_FAILURE;
    }
    for (variable = 0; variable < ancf14_variable_count(simulation) && found < COLUMNS; variable++) {
        if (ancf14_variable_kind(simulation, variable) == ANCF14_OUTPUT) {
            outputs[found++] = variable;
        }
    }

    /* Parameters would be set here: ancf14_set(simulation, ancf14_find(simulation, "steel.young"), 7e10). */
    check(simulation, ancf14_initialize(simulation));
    printf("time s");
    for (variable = 0; variable < found; variable++) {
        printf(", %s %s", ancf14_variable_name(simulation, outputs[variable]),
               ancf14_variable_unit(simulation, outputs[variable]));
    }
    rows = (long)(ancf14_stop_time(simulation) / ancf14_output_step(simulation) + 0.5);
    for (row = 0; row <= rows; row++) {
        /* Inputs would be set here. Time is a multiple of the step, never a running sum. */
        check(simulation, ancf14_advance(simulation, (double)row * ancf14_output_step(simulation)));
        printf("\n%g", ancf14_time(simulation));
        for (variable = 0; variable < found; variable++) {
            double value;
            check(simulation, ancf14_get(simulation, outputs[variable], &value));
            printf(", %g", value);
        }
    }
    printf("\n");
    check(simulation, ancf14_finish(simulation));
    while ((warning = ancf14_next_warning(simulation)) != NULL) {
        fprintf(stderr, "warning: %s\n", warning);
    }
    ancf14_free(simulation);
    return EXIT_SUCCESS;
}
