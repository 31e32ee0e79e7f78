/* SPDX-License-Identifier: MIT */
/* model.h as an FMU of FMI 2.0. */
#include "../fmi2_api.h"
#include "model.h"

#ifndef VERSION
#define VERSION "2.0"
#endif

typedef struct {
  model now;
  fmi2CallbackFunctions host;
  double reached;
  bool wants_end;
} instance;

static void say(instance* c, fmi2Status status, const char* text) {
  c->host.logger(c->host.componentEnvironment, "it", status, "logStatusError", "%s at t = %g, label '%s'", text,
                 c->now.time, c->now.label);
}

const char* fmi2GetTypesPlatform(void) { return "default"; }
const char* fmi2GetVersion(void) { return VERSION; }

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions* host, fmi2Boolean visible, fmi2Boolean logging) {
  (void)name, (void)visible, (void)logging;
  if (type != fmi2CoSimulation || strcmp(guid, "{the-token}") != 0) {
    host->logger(host->componentEnvironment, name, fmi2Error, "", "the guid %s is not mine", guid);
    return NULL;
  }
  if (!MODEL_MAY_BE_MADE) {
    host->logger(host->componentEnvironment, name, fmi2Error, "", "there is one already");
    return NULL;
  }
  ++model_instances;
  instance* c = host->allocateMemory(1, sizeof *c);
  c->host = *host;
  model_reset(&c->now);
  c->now.booleans[HAS_RESOURCE] = strncmp(resources, "file:///", 8) == 0 && model_has_resource(resources + 7);
  return c;
}
void fmi2FreeInstance(fmi2Component c) {
  --model_instances;
  free(c);
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean has_tolerance, fmi2Real tolerance, fmi2Real start,
                               fmi2Boolean has_stop, fmi2Real stop) {
  (void)has_tolerance, (void)tolerance, (void)has_stop, (void)stop;
  ((instance*)c)->now.time = start;
  return fmi2OK;
}
fmi2Status fmi2EnterInitializationMode(fmi2Component c) { return c ? fmi2OK : fmi2Error; }
fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  instance* me = c;
  if (me->now.integers[FAULT] == FAULT_AT_START) {
    say(me, fmi2Error, "I do not like this start");
    return fmi2Error;
  }
  model_outputs(&me->now);
  return fmi2OK;
}
fmi2Status fmi2Terminate(fmi2Component c) { return c ? fmi2OK : fmi2Error; }
fmi2Status fmi2Reset(fmi2Component c) {
  instance* me = c;
  const bool has_resource = me->now.booleans[HAS_RESOURCE];
  model_reset(&me->now);
  me->now.booleans[HAS_RESOURCE] = has_resource;
  return fmi2OK;
}

#define ACCESS(NAME, TYPE, WHERE)                                                                           \
  fmi2Status fmi2Get##NAME(fmi2Component c, const fmi2ValueReference vr[], size_t n, TYPE values[]) {       \
    for (size_t i = 0; i < n; ++i) values[i] = (TYPE)((instance*)c)->now.WHERE[vr[i]];                      \
    return fmi2OK;                                                                                          \
  }                                                                                                         \
  fmi2Status fmi2Set##NAME(fmi2Component c, const fmi2ValueReference vr[], size_t n, const TYPE values[]) { \
    for (size_t i = 0; i < n; ++i) ((instance*)c)->now.WHERE[vr[i]] = values[i];                            \
    return fmi2OK;                                                                                          \
  }
ACCESS(Real, fmi2Real, reals)
ACCESS(Integer, fmi2Integer, integers)
ACCESS(Boolean, fmi2Boolean, booleans)
fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t n, const fmi2String values[]) {
  (void)vr;
  for (size_t i = 0; i < n; ++i) snprintf(((instance*)c)->now.label, sizeof((instance*)c)->now.label, "%s", values[i]);
  return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real size, fmi2Boolean no_state_before) {
  (void)no_state_before;
  instance* me = c;
  me->wants_end = false;
  switch (model_step(&me->now, time, size, &me->reached)) {
    case DISCARDED:
      model_move(&me->now, me->reached); /* FMI 2 leaves the state in the middle */
      return fmi2Discard;
    case ENDED:
      me->wants_end = true;
      return fmi2Discard;
    case FAILED:
      say(me, fmi2Error, "it is all wrong");
      return fmi2Error;
    case BROKEN:
      say(me, fmi2Fatal, "it is broken");
      return fmi2Fatal;
    default:
      break;
  }
  if (me->now.integers[FAULT] == FAULT_CHATS) say(me, fmi2OK, "all is well");
  if (me->now.integers[FAULT] == FAULT_WARNS) say(me, fmi2Warning, "beware");
  if (me->now.integers[FAULT] == FAULT_PENDING) {
    me->now.pending = 2;
    return fmi2Pending;
  }
  return fmi2OK;
}
fmi2Status fmi2GetStatus(fmi2Component c, fmi2StatusKind kind, fmi2Status* value) {
  instance* me = c;
  *value = me->now.pending-- > 0 ? fmi2Pending : fmi2OK;
  return kind == fmi2DoStepStatus ? fmi2OK : fmi2Discard;
}
fmi2Status fmi2GetRealStatus(fmi2Component c, fmi2StatusKind kind, fmi2Real* value) {
  *value = ((instance*)c)->reached;
  const bool knows = ((instance*)c)->now.integers[FAULT] != FAULT_NO_LAST_TIME;
  return kind == fmi2LastSuccessfulTime && knows ? fmi2OK : fmi2Discard;
}
fmi2Status fmi2GetBooleanStatus(fmi2Component c, fmi2StatusKind kind, fmi2Boolean* value) {
  *value = ((instance*)c)->wants_end;
  return kind == fmi2Terminated ? fmi2OK : fmi2Discard;
}

#ifndef NO_STATE
fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate* state) {
  if (!*state) *state = malloc(sizeof(model));
  memcpy(*state, &((instance*)c)->now, sizeof(model));
  return fmi2OK;
}
fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
  memcpy(&((instance*)c)->now, state, sizeof(model));
  return fmi2OK;
}
fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate* state) {
  free(*state);
  *state = NULL;
  return c ? fmi2OK : fmi2Error;
}
fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t* size) {
  *size = model_size(state);
  return c ? fmi2OK : fmi2Error;
}
fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[], size_t size) {
  memset(bytes, 0, size);
  memcpy(bytes, state, sizeof(model));
  return c ? fmi2OK : fmi2Error;
}
fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size, fmi2FMUstate* state) {
  if (size < sizeof(model)) return fmi2Error;
  *state = malloc(sizeof(model));
  memcpy(*state, bytes, sizeof(model));
  return c ? fmi2OK : fmi2Error;
}
#endif
