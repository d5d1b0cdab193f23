/* Saves the state of an instance, goes on, goes back and does the same again: the numbers agree to the last bit. Then writes
 * the state to a file, from which a new instance, in this process or in another one, goes on.
 *
 * Build, in the directory that holds include/, lib/ and c-examples/, with model and header made first:
 *
 *     mkdir -p unit && cp c-examples/arm.toml unit/model.toml && ancf14 header c-examples/arm.toml --prefix ARM -o arm.h
 *     cc -std=c99 -Iinclude -I. c-examples/save_and_restore.c -Llib -lancf14 -Wl,-rpath,"$PWD/lib" -o save_and_restore
 *
 * Run, the second time from the file that the first one has written:
 *
 *     ./save_and_restore "$PWD/unit" state.bin
 *     ./save_and_restore "$PWD/unit" state.bin go-on
 */
#include <string.h>

#include "host.h"

enum { SAVED = 5, END = 10 }; /* the state is saved before step 5 of 10 */

/* The last steps, from the saved state on; the outputs at the end. */
static void go_on(fmi2Component arm, double values[OUTPUTS]) {
    long k;
    for (k = SAVED; k < END; k++) {
        step(arm, k, 2.0 * (double)k);
    }
    read_outputs(arm, values);
}

static void print(const char *who, const double values[OUTPUTS]) {
    printf("%s: tip at %.17g %.17g %.17g\n", who, values[0], values[1], values[2]);
}

static void agree(const double one[OUTPUTS], const double other[OUTPUTS]) {
    if (memcmp(one, other, OUTPUTS * sizeof(double)) != 0) {
        fprintf(stderr, "the repeated steps differ\n");
        exit(EXIT_FAILURE);
    }
}

/* Writes a saved state to a file. */
static void write_state(fmi2Component arm, fmi2FMUstate state, const char *path) {
    FILE *file = fopen(path, "wb");
    fmi2Byte *bytes;
    size_t size;

    check(fmi2SerializedFMUstateSize(arm, state, &size), "fmi2SerializedFMUstateSize");
    bytes = malloc(size);
    if (bytes == NULL || file == NULL) {
        fprintf(stderr, "cannot write %s\n", path);
        exit(EXIT_FAILURE);
    }
    check(fmi2SerializeFMUstate(arm, state, bytes, size), "fmi2SerializeFMUstate");
    if (fwrite(bytes, 1, size, file) != size || fclose(file) != 0) {
        fprintf(stderr, "cannot write %s\n", path);
        exit(EXIT_FAILURE);
    }
    free(bytes);
}

/* Reads a state from a file and takes the instance to it, whatever it did before. */
static void restore_from_file(fmi2Component arm, const char *path) {
    FILE *file = fopen(path, "rb");
    fmi2FMUstate state = NULL;
    fmi2Byte *bytes = NULL;
    long size;

    if (file == NULL || fseek(file, 0, SEEK_END) != 0 || (size = ftell(file)) < 0 || fseek(file, 0, SEEK_SET) != 0 ||
        (bytes = malloc((size_t)size)) == NULL || fread(bytes, 1, (size_t)size, file) != (size_t)size) {
        fprintf(stderr, "cannot read %s\n", path);
        exit(EXIT_FAILURE);
    }
    fclose(file);
    check(fmi2DeSerializeFMUstate(arm, bytes, (size_t)size, &state), "fmi2DeSerializeFMUstate");
    free(bytes);
    check(fmi2SetFMUstate(arm, state), "fmi2SetFMUstate");
    check(fmi2FreeFMUstate(arm, &state), "fmi2FreeFMUstate");
}

/* A new instance needs no initialization: the state brings all that it is. */
static void from_file(const char *resources, const char *path, double values[OUTPUTS]) {
    fmi2Component arm = instantiate("from a file", resources);
    restore_from_file(arm, path);
    go_on(arm, values);
    check(fmi2Terminate(arm), "fmi2Terminate");
    fmi2FreeInstance(arm);
}

int main(int count, char **words) {
    double first[OUTPUTS], again[OUTPUTS], filed[OUTPUTS];
    fmi2FMUstate state = NULL;
    fmi2Component arm;
    long k;

    if (count == 4 && strcmp(words[3], "go-on") == 0) {
        from_file(words[1], words[2], filed);
        print("from the file, in a new process", filed);
        return EXIT_SUCCESS;
    }
    if (count != 3) {
        fprintf(stderr, "usage: %s RESOURCES STATE [go-on] (the directory of model.toml, the file of the state)\n", words[0]);
        return EXIT_FAILURE;
    }

    arm = instantiate("arm", words[1]);
    initialize(arm);
    for (k = 0; k < SAVED; k++) {
        step(arm, k, 2.0 * (double)k);
    }

    /* A copy of everything that the instance is. Called again with the same variable, it is overwritten. */
    check(fmi2GetFMUstate(arm, &state), "fmi2GetFMUstate");
    go_on(arm, first);
    print("first", first);
    check(fmi2SetFMUstate(arm, state), "fmi2SetFMUstate");
    go_on(arm, again);
    print("again", again);
    agree(first, again);

    /* States belong to the instance: what is left of them goes before it. */
    write_state(arm, state, words[2]);
    check(fmi2FreeFMUstate(arm, &state), "fmi2FreeFMUstate");
    check(fmi2Terminate(arm), "fmi2Terminate");
    fmi2FreeInstance(arm);

    from_file(words[1], words[2], filed);
    print("from the file, in a new instance", filed);
    agree(first, filed);
    return EXIT_SUCCESS;
}
