/* Makes the mistakes of a C programmer with the functions ancf14_...: each must be an error with a sentence, and no crash.
 *
 *     front_mistakes MODEL.toml BAD.toml
 *
 * MODEL.toml has the output `tip.position[3]`, the input `push.force[3]`, the parameter `rod.radius` and the number `arm.elements`. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "ancf14.h"

static void check(int right, const char *what) {
    if (!right) {
        fprintf(stderr, "%s: not as expected\n", what);
        exit(EXIT_FAILURE);
    }
}

/* The call failed with this status, and its sentence has these words. */
static void fails(ancf14_simulation *simulation, ancf14_status status, ancf14_status expected, const char *words) {
    const char *sentence = ancf14_last_error(simulation);
    if (status != expected || strstr(sentence, words) == NULL) {
        fprintf(stderr, "status %d instead of %d, words `%s`: %s\n", (int)status, (int)expected, words, sentence);
        exit(EXIT_FAILURE);
    }
}

static void works(ancf14_simulation *simulation, ancf14_status status) {
    if (status != ANCF14_OK) {
        fprintf(stderr, "status %d: %s\n", (int)status, ancf14_last_error(simulation));
        exit(EXIT_FAILURE);
    }
}

/* Loading fails, and the buffer has these words; then the same with small buffers, of which no other byte is touched. */
static void does_not_load(const char *path, const char *overrides, const char *words) {
    char text[4096], small[8];
    size_t size;
    check(ancf14_load_file(path, overrides, text, sizeof text) == NULL, words);
    if (strstr(text, words) == NULL) {
        fprintf(stderr, "no `%s` in: %s\n", words, text);
        exit(EXIT_FAILURE);
    }
    for (size = 0; size < sizeof small; size++) {
        memset(small, '#', sizeof small);
        check(ancf14_load_file(path, overrides, small, size) == NULL, "small buffer");
        check(small[size] == '#', "byte behind the buffer");
        check(size == 0 || (strlen(small) == size - 1 && strncmp(small, text, size - 1) == 0), "text of a small buffer");
    }
    check(ancf14_load_file(path, overrides, NULL, 100) == NULL, "no buffer");
}

static void loading(const char *model, const char *bad) {
    char text[4096] = "left over";
    does_not_load("missing.toml", NULL, "cannot read missing.toml");
    does_not_load(bad, NULL, "error: ");
    does_not_load(model, "arm.elements", "`arm.elements` is not KEY=VALUE");
    does_not_load(model, "\n nobody.elements = 3\n", "nothing in the file is named `nobody`");
    does_not_load(NULL, NULL, "`path` is NULL");
    does_not_load("\xff", NULL, "`path` is not UTF-8");
    check(ancf14_load_text("m", NULL, NULL, text, sizeof text) == NULL && strstr(text, "`model` is NULL") != NULL, "NULL text");
    check(ancf14_load_text(NULL, "", NULL, text, sizeof text) == NULL && strstr(text, "`name` is NULL") != NULL, "NULL name");
    check(ancf14_load_text("mine", "format = 2", NULL, text, sizeof text) == NULL && strstr(text, "mine:1") != NULL, "text");
}

/* A model that includes a file from outside of its folder loads where the program trusts it. */
static void trust(const char *outside) {
    char text[4096];
    ancf14_simulation *simulation;
    does_not_load(outside, NULL, "ancf14_load_trusted_file");
    simulation = ancf14_load_trusted_file(outside, NULL, text, sizeof text);
    check(simulation != NULL && text[0] == '\0', text);
    ancf14_free(simulation);
    check(ancf14_load_trusted_file("missing.toml", NULL, text, sizeof text) == NULL && strstr(text, "cannot read") != NULL, text);
    check(ancf14_load_trusted_file(NULL, NULL, NULL, 0) == NULL, "NULL path");
}

/* Pointers that are no simulation: NULL, freed, something else. */
static void no_handle(ancf14_simulation *none) {
    double value = 7.0;
    fails(none, ancf14_get(none, 0, &value), ANCF14_BAD_HANDLE, "no live simulation");
    check(value == 7.0, "value untouched");
    fails(none, ancf14_set(none, 0, 1.0), ANCF14_BAD_HANDLE, "no live simulation");
    fails(none, ancf14_initialize(none), ANCF14_BAD_HANDLE, "no live simulation");
    fails(none, ancf14_advance(none, 1.0), ANCF14_BAD_HANDLE, "no live simulation");
    fails(none, ancf14_finish(none), ANCF14_BAD_HANDLE, "no live simulation");
    fails(none, ancf14_reset(none), ANCF14_BAD_HANDLE, "no live simulation");
    fails(none, ancf14_restore(none, NULL), ANCF14_BAD_HANDLE, "no live simulation");
    check(ancf14_save(none) == NULL && ancf14_next_warning(none) == NULL, "NULL");
    check(ancf14_find(none, "tip") == -1 && ancf14_variable_count(none) == -1, "-1");
    check(ancf14_variable_name(none, 0) == NULL && ancf14_variable_unit(none, 0) == NULL, "NULL texts");
    check(ancf14_variable_description(none, 0) == NULL, "NULL description");
    check(ancf14_variable_kind(none, 0) == ANCF14_NO_VARIABLE, "no kind");
    check(ancf14_time(none) != ancf14_time(none), "NaN time");
    check(ancf14_stop_time(none) != ancf14_stop_time(none), "NaN stop time");
    check(ancf14_output_step(none) != ancf14_output_step(none), "NaN output step");
    ancf14_free(none);
}

static void variables(ancf14_simulation *arm) {
    double value = 7.0, zero = 0.0;
    int tip = ancf14_find(arm, "tip.position[3]"), count = ancf14_variable_count(arm);
    int radius = ancf14_find(arm, "rod.radius"), elements = ancf14_find(arm, "arm.elements");
    check(tip >= 0 && radius >= 0 && elements >= 0 && ancf14_find(arm, "push.force[3]") >= 0, "names");
    check(strcmp(ancf14_variable_name(arm, tip), "tip.position[3]") == 0, "name");
    check(strcmp(ancf14_variable_unit(arm, tip), "m") == 0, "unit");
    check(strlen(ancf14_variable_description(arm, tip)) > 10, "description");
    check(ancf14_variable_kind(arm, tip) == ANCF14_OUTPUT && ancf14_variable_kind(arm, radius) == ANCF14_PARAMETER, "kinds");
    check(ancf14_variable_kind(arm, ancf14_find(arm, "push.force[3]")) == ANCF14_INPUT, "kind of an input");
    check(ancf14_find(arm, "tip.positon[3]") == -1, "unknown name");
    check(strstr(ancf14_last_error(arm), "did you mean `tip.position[3]`?") != NULL, "suggestion");
    check(ancf14_find(arm, NULL) == -1 && strstr(ancf14_last_error(arm), "`name` is NULL") != NULL, "NULL name");
    check(ancf14_find(arm, "\xff") == -1 && strstr(ancf14_last_error(arm), "`name` is not UTF-8") != NULL, "name of no text");
    check(ancf14_variable_name(arm, count) == NULL && ancf14_variable_kind(arm, -1) == ANCF14_NO_VARIABLE, "numbers");
    fails(arm, ancf14_get(arm, -1, &value), ANCF14_UNKNOWN_VARIABLE, "there is no variable");
    fails(arm, ancf14_set(arm, count, 1.0), ANCF14_UNKNOWN_VARIABLE, "there is no variable");
    fails(arm, ancf14_get(arm, radius, NULL), ANCF14_BAD_ARGUMENT, "`value` is NULL");
    fails(arm, ancf14_get(arm, tip, &value), ANCF14_WRONG_ORDER, "initialize it first");
    check(value == 7.0, "value untouched");
    fails(arm, ancf14_set(arm, radius, -1.0), ANCF14_REFUSED, "must be greater than 0, this is -1");
    fails(arm, ancf14_set(arm, radius, zero / zero), ANCF14_REFUSED, "rod.radius cannot be NaN");
    fails(arm, ancf14_set(arm, elements, 2.5), ANCF14_REFUSED, "whole number and cannot be 2.5");
    fails(arm, ancf14_set(arm, tip, 1.0), ANCF14_REFUSED, "is a result and cannot be set");
    works(arm, ancf14_set(arm, elements, 4.0));
    works(arm, ancf14_get(arm, elements, &value));
    check(value == 4.0, "a whole number");
}

static void order(ancf14_simulation *arm) {
    double value, again, zero = 0.0;
    int tip = ancf14_find(arm, "tip.position[3]");
    ancf14_state *state, *freed;
    fails(arm, ancf14_advance(arm, 0.01), ANCF14_WRONG_ORDER, "initialize it first");
    fails(arm, ancf14_finish(arm), ANCF14_WRONG_ORDER, "initialize it first");
    works(arm, ancf14_initialize(arm));
    fails(arm, ancf14_initialize(arm), ANCF14_WRONG_ORDER, "initialized already");
    fails(arm, ancf14_set(arm, ancf14_find(arm, "rod.radius"), 0.02), ANCF14_REFUSED, "rod.radius is fixed");
    works(arm, ancf14_advance(arm, 0.01));
    fails(arm, ancf14_advance(arm, 0.005), ANCF14_REFUSED, "from t = 0.01 s to t = 0.005 s");
    fails(arm, ancf14_advance(arm, zero / zero), ANCF14_REFUSED, "to t = NaN s");
    fails(arm, ancf14_advance(arm, 1.0 / zero), ANCF14_REFUSED, "to t = inf s");

    /* What is saved goes on with the same bits. */
    state = ancf14_save(arm);
    check(state != NULL, "saved");
    works(arm, ancf14_advance(arm, 0.02));
    works(arm, ancf14_get(arm, tip, &value));
    works(arm, ancf14_restore(arm, state));
    check(ancf14_time(arm) == 0.01, "time restored");
    works(arm, ancf14_advance(arm, 0.02));
    works(arm, ancf14_get(arm, tip, &again));
    check(memcmp(&value, &again, sizeof value) == 0, "the same bits");

    /* A step that fails is told, and the way back is open. */
    works(arm, ancf14_set(arm, ancf14_find(arm, "push.force[3]"), 1e300));
    check(ancf14_advance(arm, 0.03) == ANCF14_FAILED && strlen(ancf14_last_error(arm)) > 20, "a step that fails");
    fails(arm, ancf14_advance(arm, 0.03), ANCF14_WRONG_ORDER, "an earlier step failed");
    works(arm, ancf14_get(arm, tip, &again));
    works(arm, ancf14_restore(arm, state));
    works(arm, ancf14_advance(arm, 0.03));

    works(arm, ancf14_finish(arm));
    fails(arm, ancf14_advance(arm, 0.04), ANCF14_WRONG_ORDER, "the run is finished at t = 0.03 s");
    works(arm, ancf14_get(arm, tip, &again));
    works(arm, ancf14_reset(arm));
    check(ancf14_time(arm) == 0.0, "reset");

    freed = state;
    ancf14_free_state(state);
    ancf14_free_state(freed);
    ancf14_free_state(NULL);
    ancf14_free_state((ancf14_state *)(void *)arm);
    fails(arm, ancf14_restore(arm, freed), ANCF14_BAD_HANDLE, "no live state");
    fails(arm, ancf14_restore(arm, NULL), ANCF14_BAD_HANDLE, "no live state");
    fails(arm, ancf14_restore(arm, (ancf14_state *)(void *)arm), ANCF14_BAD_HANDLE, "no live state");
}

int main(int count, char **words) {
    ancf14_simulation *arm, *other;
    ancf14_state *state;
    double number = 0.0;
    char text[4096] = "left over";
    check(count == 4, "three words");
    check(strchr(ancf14_version(), '.') != NULL, "version");
    loading(words[1], words[2]);
    trust(words[3]);
    arm = ancf14_load_file(words[1], NULL, text, sizeof text);
    check(arm != NULL && text[0] == '\0', "loaded");
    check(strcmp(ancf14_last_error(arm), "") == 0 && ancf14_next_warning(arm) == NULL, "nothing to tell");
    variables(arm);
    order(arm);

    /* A state outlives its simulation, and fits the same model with the same overrides only. */
    other = ancf14_load_file(words[1], "arm.elements=5", NULL, 0);
    check(other != NULL, "other");
    state = ancf14_save(other);
    fails(arm, ancf14_restore(arm, state), ANCF14_BAD_HANDLE, "another model");
    ancf14_free(other);
    no_handle(other);
    no_handle(NULL);
    no_handle((ancf14_simulation *)(void *)&number);
    no_handle((ancf14_simulation *)(void *)state);
    other = ancf14_load_file(words[1], "arm.elements=5", NULL, 0);
    works(other, ancf14_restore(other, state));
    ancf14_free_state(state);
    ancf14_free(other);
    ancf14_free(arm);
    printf("all mistakes are errors\n");
    return EXIT_SUCCESS;
}
