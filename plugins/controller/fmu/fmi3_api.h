// SPDX-License-Identifier: MIT
// The part of the C interface of FMI 3.0 that co-simulation without events needs, for C and C++. Names, values and
// signatures are those of the standard (Modelica Association, FMI 3.0.1, sections 2.2 and 4.2).
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef void* fmi3Instance;
typedef void* fmi3InstanceEnvironment;
typedef void* fmi3FMUState;
typedef uint32_t fmi3ValueReference;
typedef bool fmi3Boolean;
typedef const char* fmi3String;
typedef uint8_t fmi3Byte;
typedef const fmi3Byte* fmi3Binary;

typedef enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal } fmi3Status;

typedef void (*fmi3LogMessageCallback)(fmi3InstanceEnvironment, fmi3Status, fmi3String category, fmi3String text);
typedef void (*fmi3IntermediateUpdateCallback)(fmi3InstanceEnvironment, double time, fmi3Boolean set_requested,
                                               fmi3Boolean get_allowed, fmi3Boolean finished, fmi3Boolean may_return,
                                               fmi3Boolean* return_requested, double* return_time);

typedef const char* fmi3GetVersionTYPE(void);
typedef fmi3Instance fmi3InstantiateCoSimulationTYPE(fmi3String name, fmi3String token, fmi3String resources,
                                                     fmi3Boolean visible, fmi3Boolean logging, fmi3Boolean event_mode,
                                                     fmi3Boolean early_return, const fmi3ValueReference intermediate[],
                                                     size_t intermediate_count, fmi3InstanceEnvironment,
                                                     fmi3LogMessageCallback, fmi3IntermediateUpdateCallback);
typedef void fmi3FreeInstanceTYPE(fmi3Instance);
typedef fmi3Status fmi3EnterConfigurationModeTYPE(fmi3Instance);
typedef fmi3Status fmi3ExitConfigurationModeTYPE(fmi3Instance);
typedef fmi3Status fmi3EnterInitializationModeTYPE(fmi3Instance, fmi3Boolean has_tolerance, double tolerance,
                                                   double start, fmi3Boolean has_stop, double stop);
typedef fmi3Status fmi3ExitInitializationModeTYPE(fmi3Instance);
typedef fmi3Status fmi3TerminateTYPE(fmi3Instance);
typedef fmi3Status fmi3ResetTYPE(fmi3Instance);

// Access to variables: `count` value references and `values` numbers; every element of an array counts.
#define FMI3_VARIABLES(NAME, NUMBER)                                                                             \
  typedef fmi3Status fmi3Get##NAME##TYPE(fmi3Instance, const fmi3ValueReference[], size_t count, NUMBER[],       \
                                         size_t values);                                                         \
  typedef fmi3Status fmi3Set##NAME##TYPE(fmi3Instance, const fmi3ValueReference[], size_t count, const NUMBER[], \
                                         size_t values);
FMI3_VARIABLES(Float32, float)
FMI3_VARIABLES(Float64, double)
FMI3_VARIABLES(Int8, int8_t)
FMI3_VARIABLES(UInt8, uint8_t)
FMI3_VARIABLES(Int16, int16_t)
FMI3_VARIABLES(UInt16, uint16_t)
FMI3_VARIABLES(Int32, int32_t)
FMI3_VARIABLES(UInt32, uint32_t)
FMI3_VARIABLES(Int64, int64_t)
FMI3_VARIABLES(UInt64, uint64_t)
FMI3_VARIABLES(Boolean, fmi3Boolean)
FMI3_VARIABLES(String, fmi3String)
#undef FMI3_VARIABLES
typedef fmi3Status fmi3GetBinaryTYPE(fmi3Instance, const fmi3ValueReference[], size_t count, size_t sizes[],
                                     fmi3Binary[], size_t values);
typedef fmi3Status fmi3SetBinaryTYPE(fmi3Instance, const fmi3ValueReference[], size_t count, const size_t sizes[],
                                     const fmi3Binary[], size_t values);

typedef fmi3Status fmi3GetFMUStateTYPE(fmi3Instance, fmi3FMUState*);
typedef fmi3Status fmi3SetFMUStateTYPE(fmi3Instance, fmi3FMUState);
typedef fmi3Status fmi3FreeFMUStateTYPE(fmi3Instance, fmi3FMUState*);
typedef fmi3Status fmi3SerializedFMUStateSizeTYPE(fmi3Instance, fmi3FMUState, size_t*);
typedef fmi3Status fmi3SerializeFMUStateTYPE(fmi3Instance, fmi3FMUState, fmi3Byte[], size_t);
typedef fmi3Status fmi3DeserializeFMUStateTYPE(fmi3Instance, const fmi3Byte[], size_t, fmi3FMUState*);

typedef fmi3Status fmi3DoStepTYPE(fmi3Instance, double time, double size, fmi3Boolean no_state_before,
                                  fmi3Boolean* event_needed, fmi3Boolean* terminate, fmi3Boolean* early_return,
                                  double* last_time);
