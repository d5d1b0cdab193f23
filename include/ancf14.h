/* ancf14: flexible beams behind the functions of FMI 2.0 for co-simulation.
 *
 * Generated from src/ffi by cbindgen; do not edit. The names and types are those of the standard's fmi2Functions.h:
 * include either this header or that one.
 *
 * A live instance, in what follows, comes from fmi2Instantiate, was not freed, and is not in use on another thread. NULL
 * is answered with an error. */

#ifndef ANCF14_H
#define ANCF14_H

#include <stddef.h>

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
 True.
 */
#define fmi2True 1

/*
 False.
 */
#define fmi2False 0

/*
 Not offered by this library.
 */
#define fmi2ModelExchange 0

/*
 What this library is for.
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
 Loads `resources/model.toml` and makes an instance of it; NULL with a log line if that is not possible
 (section 2.1.5).

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
 `c` is a live instance; `serializedState` has `size` bytes; `FMUstate` points to NULL or to a copy made by this library.
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

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* ANCF14_H */
