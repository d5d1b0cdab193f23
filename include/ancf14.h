/* ancf14: flexible beams for programs in C and C++.
 *
 * Generated from src/ffi by cbindgen; do not edit. docs/programming.md shows how to use it.
 *
 * The functions ancf14_... run a model file: load, set parameters and inputs, initialize, advance, read. The functions fmi2... are those of
 * FMI 2.0, for a packed model; their names and types are those of the standard's fmi2Functions.h: include either this
 * header or that one.
 *
 * Units: SI everywhere (m, kg, s, N, rad). Texts: UTF-8 that ends with a zero byte.
 *
 * Errors: every call checks its arguments and its order, and answers with an error where they are wrong; NULL and handles that were freed
 * are found too. No call ends the program, and none prints.
 *
 * Threads: different simulations, or instances, may run in different threads at the same time. One of them is used by one thread at a
 * time, and so is a saved state; any thread will do. There is no global state.
 *
 * Lifetimes: a simulation lives until ancf14_free, an instance until fmi2FreeInstance, a saved state until it is freed, whatever becomes of
 * the others. Texts that a simulation returns are its own; do not free them. What a call is given can go away when it returns.
 *
 * A live instance, in what is said of the functions fmi2..., comes from fmi2Instantiate, was not freed, and is not in use on another
 * thread. */

#ifndef ANCF14_H
#define ANCF14_H

#include <stddef.h>

/*
 What a variable is, and so when it can be set.
 */
typedef enum {
  /*
   There is no such variable.
   */
  ANCF14_NO_VARIABLE,
  /*
   A number of the model file; it can be set before ancf14_initialize.
   */
  ANCF14_PARAMETER,
  /*
   A number of the model file that can be set between two steps too.
   */
  ANCF14_TUNABLE,
  /*
   A number of the model file that follows from others; it cannot be set.
   */
  ANCF14_CALCULATED,
  /*
   A number that the program gives; it can be set at any time, and acts from the next step on.
   */
  ANCF14_INPUT,
  /*
   A result; it can be read after ancf14_initialize.
   */
  ANCF14_OUTPUT,
} ancf14_kind;

/*
 What a call reports. ancf14_last_error has the sentence that belongs to it.
 */
typedef enum {
  /*
   The call succeeded.
   */
  ANCF14_OK,
  /*
   The simulation, or the state, is NULL, was freed, or is another pointer; or the state belongs to another model.
   Nothing was touched.
   */
  ANCF14_BAD_HANDLE,
  /*
   Another argument is NULL where an address is needed, or is not UTF-8 text.
   */
  ANCF14_BAD_ARGUMENT,
  /*
   The model has no variable with this number or name.
   */
  ANCF14_UNKNOWN_VARIABLE,
  /*
   The value is out of range, the variable cannot be set now, or the time lies in the past. Nothing was changed.
   */
  ANCF14_REFUSED,
  /*
   The call comes too early, too late, or after a failed step.
   */
  ANCF14_WRONG_ORDER,
  /*
   The mechanism has no initial state, or a step cannot be computed: ancf14_restore or ancf14_reset goes on.
   */
  ANCF14_FAILED,
  /*
   A defect of the library. The simulation is unusable, and can only be freed.
   */
  ANCF14_FAULT,
} ancf14_status;

/*
 What a call reports.
 */
typedef enum {
  /*
   All well.
   */
  fmi2OK,
  /*
   Something is odd, see the log.
   */
  fmi2Warning,
  /*
   The question has no answer here.
   */
  fmi2Discard,
  /*
   The call failed, see the log.
   */
  fmi2Error,
  /*
   The instance is unusable.
   */
  fmi2Fatal,
  /*
   Never returned: steps are synchronous.
   */
  fmi2Pending,
} fmi2Status;

/*
 A model that is loaded and runs, made by ancf14_load_file or ancf14_load_text.
 */
typedef struct ancf14_simulation ancf14_simulation;

/*
 A copy of a simulation to go back to, made by ancf14_save.
 */
typedef struct ancf14_state ancf14_state;

/*
 An instance, made by `fmi2Instantiate`.
 */
typedef void *fmi2Component;

/*
 `fmi2True` or `fmi2False`.
 */
typedef int fmi2Boolean;

/*
 A byte of text.
 */
typedef char fmi2Char;

/*
 Text in UTF-8 that ends with a zero byte.
 */
typedef const fmi2Char *fmi2String;

/*
 `fmi2ModelExchange` or `fmi2CoSimulation`.
 */
typedef int fmi2Type;

/*
 What the host wants to be handed back with every callback.
 */
typedef void *fmi2ComponentEnvironment;

/*
 Takes a log line: environment, instance name, status, category, printf format, and no further arguments.
 */
typedef void (*fmi2CallbackLogger)(fmi2ComponentEnvironment componentEnvironment,
                                   fmi2String instanceName,
                                   fmi2Status status,
                                   fmi2String category,
                                   fmi2String message,
                                   ...);

/*
 Not used by this library.
 */
typedef void *(*fmi2CallbackAllocateMemory)(size_t nobj, size_t size);

/*
 Not used by this library.
 */
typedef void (*fmi2CallbackFreeMemory)(void *obj);

/*
 Not used by this library.
 */
typedef void (*fmi2StepFinished)(fmi2ComponentEnvironment componentEnvironment, fmi2Status status);

/*
 What the host offers to an instance. Only the logger is used; it may be NULL.
 */
typedef struct {
  /*
   Takes log lines.
   */
  fmi2CallbackLogger logger;
  /*
   Not used.
   */
  fmi2CallbackAllocateMemory allocateMemory;
  /*
   Not used.
   */
  fmi2CallbackFreeMemory freeMemory;
  /*
   Not used.
   */
  fmi2StepFinished stepFinished;
  /*
   Handed back with every callback.
   */
  fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;

/*
 A double.
 */
typedef double fmi2Real;

/*
 A copy of an instance, made by `fmi2GetFMUstate`.
 */
typedef void *fmi2FMUstate;

/*
 A byte of a serialized FMU state.
 */
typedef char fmi2Byte;

/*
 `fmi2DoStepStatus`, `fmi2PendingStatus`, `fmi2LastSuccessfulTime` or `fmi2Terminated`.
 */
typedef int fmi2StatusKind;

/*
 An int.
 */
typedef int fmi2Integer;

/*
 Names a variable.
 */
typedef unsigned int fmi2ValueReference;

/*
 The answer of `fmi2NewDiscreteStates`.
 */
typedef struct {
  /*
   Always false.
   */
  fmi2Boolean newDiscreteStatesNeeded;
  /*
   Always false.
   */
  fmi2Boolean terminateSimulation;
  /*
   Always false.
   */
  fmi2Boolean nominalsOfContinuousStatesChanged;
  /*
   Always false.
   */
  fmi2Boolean valuesOfContinuousStatesChanged;
  /*
   Always false.
   */
  fmi2Boolean nextEventTimeDefined;
  /*
   Not defined, s.
   */
  fmi2Real nextEventTime;
} fmi2EventInfo;

/*
 True.
 */
#define fmi2True 1

/*
 False.
 */
#define fmi2False 0

/*
 The host integrates the states: of a linear system only.
 */
#define fmi2ModelExchange 0

/*
 The unit takes the steps.
 */
#define fmi2CoSimulation 1

/*
 For `fmi2GetStatus`.
 */
#define fmi2DoStepStatus 0

/*
 For `fmi2GetStringStatus`.
 */
#define fmi2PendingStatus 1

/*
 For `fmi2GetRealStatus`.
 */
#define fmi2LastSuccessfulTime 2

/*
 For `fmi2GetBooleanStatus`.
 */
#define fmi2Terminated 3

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/*
 The version of the library: "0.1.0".
 */
const char *ancf14_version(void);

/*
 Loads the model file at `path`. `overrides` is NULL, or changes numbers and words of the file as --set of the
 command line does, one KEY=VALUE a line: "arm.elements=16\narm.strain=small".

 Returns NULL where the file cannot be read or is wrong; `error` then has the reason, all mistakes of the file with
 their lines, cut to `size` bytes, a zero byte included. `error` may be NULL; 4096 bytes are enough for most files.
 Free the simulation with ancf14_free.
 */
ancf14_simulation *ancf14_load_file(const char *path,
                                    const char *overrides,
                                    char *error,
                                    size_t size);

/*
 Loads the model file at `path`, which you trust: it may include files and read tables from outside of its folder,
 where ancf14_load_file returns an error. All else is as there.
 */
ancf14_simulation *ancf14_load_trusted_file(const char *path,
                                            const char *overrides,
                                            char *error,
                                            size_t size);

/*
 Loads a model from memory: `model` is the text of a model file, `name` what messages call it. All else is as in
 ancf14_load_file.
 */
ancf14_simulation *ancf14_load_text(const char *name,
                                    const char *model,
                                    const char *overrides,
                                    char *error,
                                    size_t size);

/*
 Frees a simulation; NULL is fine. The texts that belong to it are gone, its saved states are not.
 */
void ancf14_free(ancf14_simulation *simulation);

/*
 The reason why the last failed call with this simulation failed: a sentence with numbers that says what to do. It is
 empty if no call has failed, and never NULL. It is valid until the next call that fails.
 */
const char *ancf14_last_error(ancf14_simulation *simulation);

/*
 The oldest warning that was not fetched yet, or NULL if there is none. A warning is a sentence about results that
 should not be trusted, or about a model that is legal but probably not what was meant. It is valid until the next
 call of this function.
 */
const char *ancf14_next_warning(ancf14_simulation *simulation);

/*
 The number of variables, which are numbered from 0; -1 if the handle is not a live simulation.
 */
int ancf14_variable_count(ancf14_simulation *simulation);

/*
 The number of the variable called `name`, for instance `tip.displacement[3]`; -1: there is none, and
 ancf14_last_error suggests the nearest name. The numbers of a model file do not change.
 */
int ancf14_find(ancf14_simulation *simulation,
                const char *name);

/*
 The name of a variable; NULL: there is none with this number. It is valid as long as the simulation.
 */
const char *ancf14_variable_name(ancf14_simulation *simulation,
                                 int variable);

/*
 The SI unit of a variable, "N.m" or "rad/s"; empty: it has none; NULL: there is no such variable. It is valid as
 long as the simulation.
 */
const char *ancf14_variable_unit(ancf14_simulation *simulation,
                                 int variable);

/*
 What a variable means, with axes and sign; NULL: there is no such variable. It is valid as long as the simulation.
 */
const char *ancf14_variable_description(ancf14_simulation *simulation,
                                        int variable);

/*
 What a variable is; ANCF14_NO_VARIABLE: there is none with this number.
 */
ancf14_kind ancf14_variable_kind(ancf14_simulation *simulation, int variable);

/*
 Reads a variable: the number of a parameter at any time, a result after ancf14_initialize.
 */
ancf14_status ancf14_get(ancf14_simulation *simulation, int variable, double *value);

/*
 Sets a variable: a parameter before ancf14_initialize, a tunable parameter or an input at any time. An input keeps
 its value until it is set again. A value that is refused leaves the old one.
 */
ancf14_status ancf14_set(ancf14_simulation *simulation,
                         int variable,
                         double value);

/*
 Builds the mechanism from the parameters as set, and finds its initial state, at t = 0 or at the time of the state
 that the model begins with. After a failure other parameters can be tried.
 */
ancf14_status ancf14_initialize(ancf14_simulation *simulation);

/*
 Advances to `time`, s, in the internal steps of the model file. Times that are multiples of its simulation.step give
 the bits of `ancf14 run`; compute them as k * step, not as a running sum.
 */
ancf14_status ancf14_advance(ancf14_simulation *simulation,
                             double time);

/*
 Ends the run, so that ancf14_next_warning has those on the run as a whole: how far results are off because of the
 length of the steps. Values can still be read.
 */
ancf14_status ancf14_finish(ancf14_simulation *simulation);

/*
 Goes back to the model as it was loaded, parameters and inputs included: for the next run of a study.
 */
ancf14_status ancf14_reset(ancf14_simulation *simulation);

/*
 The time reached, s; NaN if the handle is not a live simulation.
 */
double ancf14_time(ancf14_simulation *simulation);

/*
 The time at which a run ends by the model file, s; NaN if the handle is not a live simulation. Nothing keeps a
 program from advancing further.
 */
double ancf14_stop_time(ancf14_simulation *simulation);

/*
 The time between two rows of results by the model file, s; NaN if the handle is not a live simulation.
 */
double ancf14_output_step(ancf14_simulation *simulation);

/*
 Copies all that changes: parameters, inputs, time and motion; NULL where that is not possible. Free the copy with
 ancf14_free_state.
 */
ancf14_state *ancf14_save(ancf14_simulation *simulation);

/*
 Goes back to a copy, also after a failed step. The copy stays; it may come from another simulation of the same model
 with the same overrides. What follows has the same bits each time.
 */
ancf14_status ancf14_restore(ancf14_simulation *simulation,
                             ancf14_state *state);

/*
 Frees a copy; NULL is fine.
 */
void ancf14_free_state(ancf14_state *state);

/*
 `"default"`: the types are those of the standard's header (section 2.1.4).
 */
const char *fmi2GetTypesPlatform(void);

/*
 `"2.0"` (section 2.1.4).
 */
const char *fmi2GetVersion(void);

/*
 Switches debug messages; no category means all (section 2.1.5).

 # Safety
 `c` is a live instance; `categories` has `nCategories` texts.
 */
fmi2Status fmi2SetDebugLogging(fmi2Component c,
                               fmi2Boolean loggingOn,
                               size_t nCategories,
                               const fmi2String *categories);

/*
 Loads the model of the resources, `resources/model.toml` or `resources/linear.toml`, and makes an instance of it;
 NULL with a log line if that is not possible (section 2.1.5).

 # Safety
 The texts end with a zero byte, `functions` holds functions that can be called as long as the instance lives.
 */
fmi2Component fmi2Instantiate(fmi2String instanceName,
                              fmi2Type fmuType,
                              fmi2String fmuGUID,
                              fmi2String fmuResourceLocation,
                              const fmi2CallbackFunctions *functions,
                              fmi2Boolean visible,
                              fmi2Boolean loggingOn);

/*
 Gives an instance back; NULL is fine (section 2.1.5).

 # Safety
 `c` is a live instance, which is not used again.
 */
void fmi2FreeInstance(fmi2Component c);

/*
 Start and stop time, s; the tolerance is not used (section 2.1.6).

 # Safety
 `c` is a live instance.
 */
fmi2Status fmi2SetupExperiment(fmi2Component c,
                               fmi2Boolean toleranceDefined,
                               fmi2Real tolerance,
                               fmi2Real startTime,
                               fmi2Boolean stopTimeDefined,
                               fmi2Real stopTime);

/*
 Enters Initialization Mode (section 2.1.6).

 # Safety
 `c` is a live instance.
 */
fmi2Status fmi2EnterInitializationMode(fmi2Component c);

/*
 Finds the initial state and leaves Initialization Mode (section 2.1.6).

 # Safety
 `c` is a live instance.
 */
fmi2Status fmi2ExitInitializationMode(fmi2Component c);

/*
 Ends the simulation; values can still be read (section 2.1.6).

 # Safety
 `c` is a live instance.
 */
fmi2Status fmi2Terminate(fmi2Component c);

/*
 Back to just instantiated, also after an error (section 2.1.6).

 # Safety
 `c` is a live instance.
 */
fmi2Status fmi2Reset(fmi2Component c);

/*
 Copies everything the instance is; over an earlier copy if there is one (section 2.1.8).

 # Safety
 `c` is a live instance; `FMUstate` points to NULL or to a copy made by this library.
 */
fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *FMUstate);

/*
 Goes back to a copy, also after an error (section 2.1.8).

 # Safety
 `c` is a live instance; `FMUstate` is a copy made by this library.
 */
fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate FMUstate);

/*
 Gives a copy back; NULL is fine (section 2.1.8).

 # Safety
 `c` is a live instance; `FMUstate` points to NULL or to a copy made by this library, which is not used again.
 */
fmi2Status fmi2FreeFMUstate(fmi2Component c,
                            fmi2FMUstate *FMUstate);

/*
 The number of bytes that a copy is serialized to (section 2.1.8).

 # Safety
 `c` is a live instance; `FMUstate` is a copy made by this library; `size` can be written to.
 */
fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate FMUstate, size_t *size);

/*
 Writes a copy as bytes that any process can read (section 2.1.8).

 # Safety
 `c` is a live instance; `FMUstate` is a copy made by this library; `serializedState` has room for `size` bytes.
 */
fmi2Status fmi2SerializeFMUstate(fmi2Component c,
                                 fmi2FMUstate FMUstate,
                                 fmi2Byte *serializedState,
                                 size_t size);

/*
 Makes a copy from bytes, over an earlier copy if there is one (section 2.1.8).

 # Safety
 `c` is a live instance; `serializedState` has `size` bytes; `FMUstate` points to NULL or to a copy made by this
 library.
 */
fmi2Status fmi2DeSerializeFMUstate(fmi2Component c,
                                   const fmi2Byte *serializedState,
                                   size_t size,
                                   fmi2FMUstate *FMUstate);

/*
 Computes one communication step, s (section 4.2.2).

 # Safety
 `c` is a live instance.
 */
fmi2Status fmi2DoStep(fmi2Component c,
                      fmi2Real currentCommunicationPoint,
                      fmi2Real communicationStepSize,
                      fmi2Boolean noSetFMUStatePriorToCurrentPoint);

/*
 Always an error: steps are done when `fmi2DoStep` returns (section 4.2.2).

 # Safety
 `c` is a live instance.
 */
fmi2Status fmi2CancelStep(fmi2Component c);

/*
 `fmi2Discard`: no status of this type exists, since steps are never pending (section 4.2.3).

 # Safety
 `c` is a live instance.
 */
fmi2Status fmi2GetStatus(fmi2Component c, fmi2StatusKind s, fmi2Status *value);

/*
 The time reached, s, for `fmi2LastSuccessfulTime`; otherwise `fmi2Discard` (section 4.2.3).

 # Safety
 `c` is a live instance; `value` can be written to.
 */
fmi2Status fmi2GetRealStatus(fmi2Component c, fmi2StatusKind s, fmi2Real *value);

/*
 `fmi2Discard`: no status of this type exists (section 4.2.3).

 # Safety
 `c` is a live instance.
 */
fmi2Status fmi2GetIntegerStatus(fmi2Component c, fmi2StatusKind s, fmi2Integer *value);

/*
 False for `fmi2Terminated`: the unit never ends by itself; otherwise `fmi2Discard` (section 4.2.3).

 # Safety
 `c` is a live instance; `value` can be written to.
 */
fmi2Status fmi2GetBooleanStatus(fmi2Component c, fmi2StatusKind s, fmi2Boolean *value);

/*
 `fmi2Discard`: no status of this type exists (section 4.2.3).

 # Safety
 `c` is a live instance.
 */
fmi2Status fmi2GetStringStatus(fmi2Component c, fmi2StatusKind s, fmi2String *value);

/*
 Reads Real variables (section 2.1.7).

 # Safety
 `c` is a live instance; the arrays have `nvr` elements.
 */
fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference *vr, size_t nvr, fmi2Real *value);

/*
 Sets Real variables: all of them, or none if one is refused (section 2.1.7).

 # Safety
 `c` is a live instance; the arrays have `nvr` elements.
 */
fmi2Status fmi2SetReal(fmi2Component c,
                       const fmi2ValueReference *vr,
                       size_t nvr,
                       const fmi2Real *value);

/*
 Reads Integer variables (section 2.1.7).

 # Safety
 `c` is a live instance; the arrays have `nvr` elements.
 */
fmi2Status fmi2GetInteger(fmi2Component c,
                          const fmi2ValueReference *vr,
                          size_t nvr,
                          fmi2Integer *value);

/*
 Sets Integer variables: all of them, or none if one is refused (section 2.1.7).

 # Safety
 `c` is a live instance; the arrays have `nvr` elements.
 */
fmi2Status fmi2SetInteger(fmi2Component c,
                          const fmi2ValueReference *vr,
                          size_t nvr,
                          const fmi2Integer *value);

/*
 Reads Boolean variables, of which there are none: an error unless `nvr` is 0 (section 2.1.7).

 # Safety
 `c` is a live instance; the arrays have `nvr` elements.
 */
fmi2Status fmi2GetBoolean(fmi2Component c,
                          const fmi2ValueReference *vr,
                          size_t nvr,
                          fmi2Boolean *value);

/*
 Sets Boolean variables, of which there are none: an error unless `nvr` is 0 (section 2.1.7).

 # Safety
 `c` is a live instance; the arrays have `nvr` elements.
 */
fmi2Status fmi2SetBoolean(fmi2Component c,
                          const fmi2ValueReference *vr,
                          size_t nvr,
                          const fmi2Boolean *value);

/*
 Reads String variables, of which there are none: an error unless `nvr` is 0 (section 2.1.7).

 # Safety
 `c` is a live instance; the arrays have `nvr` elements.
 */
fmi2Status fmi2GetString(fmi2Component c,
                         const fmi2ValueReference *vr,
                         size_t nvr,
                         fmi2String *value);

/*
 Sets String variables, of which there are none: an error unless `nvr` is 0 (section 2.1.7).

 # Safety
 `c` is a live instance; the arrays have `nvr` elements.
 */
fmi2Status fmi2SetString(fmi2Component c,
                         const fmi2ValueReference *vr,
                         size_t nvr,
                         const fmi2String *value);

/*
 Sets first derivatives of Real inputs by time, for the next step only (section 4.2.1).

 # Safety
 `c` is a live instance; the arrays have `nvr` elements.
 */
fmi2Status fmi2SetRealInputDerivatives(fmi2Component c,
                                       const fmi2ValueReference *vr,
                                       size_t nvr,
                                       const fmi2Integer *order,
                                       const fmi2Real *value);

/*
 Reads first derivatives of Real outputs by time (section 4.2.1).

 # Safety
 `c` is a live instance; the arrays have `nvr` elements.
 */
fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c,
                                        const fmi2ValueReference *vr,
                                        size_t nvr,
                                        const fmi2Integer *order,
                                        fmi2Real *value);

/*
 The change of outputs at the end of the last step with the inputs of that step (section 2.1.9).

 # Safety
 `c` is a live instance; the arrays of unknowns have `nUnknown` elements, those of knowns `nKnown`.
 */
fmi2Status fmi2GetDirectionalDerivative(fmi2Component c,
                                        const fmi2ValueReference *vUnknown_ref,
                                        size_t nUnknown,
                                        const fmi2ValueReference *vKnown_ref,
                                        size_t nKnown,
                                        const fmi2Real *dvKnown,
                                        fmi2Real *dvUnknown);

/*
 Enters Event Mode, where inputs may jump (section 3.2.2).

 # Safety
 `c` is a live instance.
 */
fmi2Status fmi2EnterEventMode(fmi2Component c);

/*
 Says that no event follows: the unit has none of its own (section 3.2.2).

 # Safety
 `c` is a live instance; `eventInfo` can be written to.
 */
fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo *eventInfo);

/*
 Enters Continuous-Time Mode (section 3.2.2).

 # Safety
 `c` is a live instance.
 */
fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c);

/*
 Takes note of a completed step of the host's solver: no event follows (section 3.2.2).

 # Safety
 `c` is a live instance; both answers can be written to.
 */
fmi2Status fmi2CompletedIntegratorStep(fmi2Component c,
                                       fmi2Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi2Boolean *enterEventMode,
                                       fmi2Boolean *terminateSimulation);

/*
 Sets the time, s (section 3.2.1).

 # Safety
 `c` is a live instance.
 */
fmi2Status fmi2SetTime(fmi2Component c, fmi2Real time);

/*
 Sets the states: all of them, or none if one is refused (section 3.2.1).

 # Safety
 `c` is a live instance; `x` has `nx` elements.
 */
fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real *x, size_t nx);

/*
 Reads the derivatives of the states by time (section 3.2.2).

 # Safety
 `c` is a live instance; `derivatives` has `nx` elements.
 */
fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real *derivatives, size_t nx);

/*
 There are no event indicators: an error unless `ni` is 0 (section 3.2.2).

 # Safety
 `c` is a live instance.
 */
fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real *eventIndicators, size_t ni);

/*
 Reads the states (section 3.2.2).

 # Safety
 `c` is a live instance; `x` has `nx` elements.
 */
fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real *x, size_t nx);

/*
 Reads the orders of magnitude of the states, which never change (section 3.2.2).

 # Safety
 `c` is a live instance; `x_nominal` has `nx` elements.
 */
fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real *x_nominal, size_t nx);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* ANCF14_H */
