/* SPDX-License-Identifier: MIT */
/* model.h as an FMU of FMI 3.0. */
#include "../fmi3_api.h"
#include "model.h"

typedef struct {
  model now;
  fmi3LogMessageCallback log;
  fmi3InstanceEnvironment host;
  bool may_return_early;
  bool is_configuring, is_configured; /* in configuration mode, and after it */
} instance;

static void say(instance* c, fmi3Status status, const char* text) {
  char line[200];
  snprintf(line, sizeof line, "%s at t = %g, label '%s'", text, c->now.time, c->now.label);
  c->log(c->host, status, "logStatusError", line);
}

const char* fmi3GetVersion(void) { return "3.0"; }

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
                                         fmi3Boolean logging, fmi3Boolean event_mode, fmi3Boolean early_return,
                                         const fmi3ValueReference intermediate[], size_t intermediate_count,
                                         fmi3InstanceEnvironment host, fmi3LogMessageCallback log,
                                         fmi3IntermediateUpdateCallback update) {
  (void)name, (void)visible, (void)logging, (void)intermediate, (void)update;
  if (strcmp(token, "{the-token}") != 0 || event_mode || intermediate_count > 0) {
    log(host, fmi3Error, "", "the instantiationToken is not mine");
    return NULL;
  }
  if (!MODEL_MAY_BE_MADE) {
    log(host, fmi3Error, "", "there is one already");
    return NULL;
  }
  ++model_instances;
  instance* c = calloc(1, sizeof *c);
  c->log = log;
  c->host = host;
  c->may_return_early = early_return;
  model_reset(&c->now);
  const size_t end = resources ? strlen(resources) : 0;
  c->now.booleans[HAS_RESOURCE] =
      end > 0 && resources[0] == '/' && resources[end - 1] == '/' && model_has_resource(resources);
  return c;
}
void fmi3FreeInstance(fmi3Instance c) {
  --model_instances;
  free(c);
}

/* Structural parameters are set only in configuration mode. */
fmi3Status fmi3EnterConfigurationMode(fmi3Instance c) {
  instance* me = c;
  if (me->is_configuring || me->is_configured) return fmi3Error;
  me->is_configuring = true;
  return fmi3OK;
}
fmi3Status fmi3ExitConfigurationMode(fmi3Instance c) {
  instance* me = c;
  if (!me->is_configuring) return fmi3Error;
  me->is_configuring = false;
  me->is_configured = true;
  return fmi3OK;
}
static bool may_be_set(instance* c, bool is_structural) {
  if (is_structural == c->is_configuring) return true;
  say(c, fmi3Error, is_structural ? "not in configuration mode" : "in configuration mode");
  return false;
}
static bool set_unsigned(instance* c, fmi3ValueReference reference, uint64_t value) {
  if (!may_be_set(c, reference == LENGTH)) return false;
  const size_t most = sizeof c->now.vector / sizeof c->now.vector[0];
  if (reference == LENGTH && value > most) {
    say(c, fmi3Error, "length is at most 8");
    return false;
  }
  *(reference == LENGTH ? &c->now.length : &c->now.u64) = value;
  return true;
}
static bool set_flag(instance* c, fmi3ValueReference reference, bool value) {
  if (!may_be_set(c, reference == AS_IT_IS)) return false;
  c->now.booleans[reference] = value;
  return true;
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean has_tolerance, double tolerance, double start,
                                       fmi3Boolean has_stop, double stop) {
  (void)has_tolerance, (void)tolerance, (void)has_stop, (void)stop;
  if (!may_be_set(c, false)) return fmi3Error;
  ((instance*)c)->is_configured = true;
  ((instance*)c)->now.time = start;
  return fmi3OK;
}
fmi3Status fmi3ExitInitializationMode(fmi3Instance c) {
  instance* me = c;
  if (me->now.integers[FAULT] == FAULT_AT_START) {
    say(me, fmi3Error, "I do not like this start");
    return fmi3Error;
  }
  model_outputs(&me->now);
  return fmi3OK;
}
fmi3Status fmi3Terminate(fmi3Instance c) { return c ? fmi3OK : fmi3Error; }
fmi3Status fmi3Reset(fmi3Instance c) { return c ? fmi3Error : fmi3OK; /* so that a new instance is made */ }

/* Value references from 100: a number of each type, the same for input and output; 200: a vector; 210: bytes. */
#define ACCESS(NAME, TYPE, READ, WRITE)                                                                            \
  fmi3Status fmi3Get##NAME(fmi3Instance c, const fmi3ValueReference vr[], size_t n, TYPE values[], size_t count) { \
    const model* m = &((instance*)c)->now;                                                                         \
    for (size_t i = 0; i < n; ++i) values[i] = (TYPE)(READ);                                                       \
    return vr && n == count ? fmi3OK : fmi3Error;                                                                  \
  }                                                                                                                \
  fmi3Status fmi3Set##NAME(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const TYPE values[],           \
                           size_t count) {                                                                         \
    model* m = &((instance*)c)->now;                                                                               \
    (void)m;                                                                                                       \
    for (size_t i = 0; i < n; ++i) WRITE;                                                                          \
    return vr && n == count ? fmi3OK : fmi3Error;                                                                  \
  }
ACCESS(Float32, float, m->f32, m->f32 = values[i])
ACCESS(Int64, int64_t, vr[i] < 100 ? m->integers[vr[i]] : m->i64,
       *(vr[i] < 100 ? &m->integers[vr[i]] : &m->i64) = values[i])
ACCESS(UInt64, uint64_t, vr[i] == LENGTH ? m->length : m->u64, if (!set_unsigned(c, vr[i], values[i])) return fmi3Error)
ACCESS(Int32, int32_t, vr[i] < 100 ? (int32_t)m->integers[vr[i]] : m->i32,
       if (vr[i] < 100) m->integers[vr[i]] = values[i];
       else m->i32 = values[i])
ACCESS(UInt32, uint32_t, m->u32, m->u32 = values[i])
ACCESS(Int16, int16_t, m->i16, m->i16 = values[i])
ACCESS(UInt16, uint16_t, m->u16, m->u16 = values[i])
ACCESS(Int8, int8_t, m->i8, m->i8 = values[i])
ACCESS(UInt8, uint8_t, m->u8, m->u8 = values[i])
ACCESS(Boolean, bool, m->booleans[vr[i]], if (!set_flag(c, vr[i], values[i])) return fmi3Error)

fmi3Status fmi3GetFloat64(fmi3Instance c, const fmi3ValueReference vr[], size_t n, double values[], size_t count) {
  model* m = &((instance*)c)->now;
  size_t k = 0;
  for (size_t i = 0; i < n; ++i)
    if (vr[i] < 100)
      values[k++] = m->reals[vr[i]];
    else
      for (int j = 0; j < 3; ++j) values[k++] = -m->vector[j];
  return k == count ? fmi3OK : fmi3Error;
}
fmi3Status fmi3SetFloat64(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const double values[],
                          size_t count) {
  model* m = &((instance*)c)->now;
  size_t k = 0;
  for (size_t i = 0; i < n; ++i)
    if (vr[i] < 100)
      m->reals[vr[i]] = values[k++];
    else
      for (size_t j = 0; j < m->length && k < count; ++j) m->vector[j] = values[k++];
  return k == count ? fmi3OK : fmi3Error;
}
fmi3Status fmi3SetString(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const fmi3String values[],
                         size_t count) {
  (void)vr, (void)count;
  for (size_t i = 0; i < n; ++i) snprintf(((instance*)c)->now.label, sizeof((instance*)c)->now.label, "%s", values[i]);
  return fmi3OK;
}
fmi3Status fmi3GetBinary(fmi3Instance c, const fmi3ValueReference vr[], size_t n, size_t sizes[], fmi3Binary values[],
                         size_t count) {
  (void)vr, (void)count;
  for (size_t i = 0; i < n; ++i) {
    sizes[i] = sizeof((instance*)c)->now.bytes;
    values[i] = ((instance*)c)->now.bytes;
  }
  return fmi3OK;
}
fmi3Status fmi3SetBinary(fmi3Instance c, const fmi3ValueReference vr[], size_t n, const size_t sizes[],
                         const fmi3Binary values[], size_t count) {
  model* m = &((instance*)c)->now;
  (void)vr, (void)count;
  for (size_t i = 0; i < n; ++i) {
    if (sizes[i] != sizeof m->bytes) return fmi3Error;
    for (size_t j = 0; j < sizes[i]; ++j) m->bytes[j] = values[i][sizes[i] - 1 - j];
  }
  return fmi3OK;
}

fmi3Status fmi3DoStep(fmi3Instance c, double time, double size, fmi3Boolean no_state_before, fmi3Boolean* event_needed,
                      fmi3Boolean* terminate, fmi3Boolean* early_return, double* last_time) {
  (void)no_state_before;
  instance* me = c;
  *event_needed = *terminate = *early_return = false;
  *last_time = time + size;
  double reached = 0;
  switch (model_step(&me->now, time, size, &reached)) {
    case DISCARDED: /* FMI 3 leaves the state unchanged */
      return fmi3Discard;
    case ENDED:
      *terminate = true;
      break;
    case EVENT:
      *event_needed = true;
      break;
    case EARLY:
      if (!me->may_return_early) say(me, fmi3Warning, "early without leave");
      *early_return = true;
      *last_time = reached;
      break;
    case FAILED:
      say(me, fmi3Error, "it is all wrong");
      return fmi3Error;
    case BROKEN:
      say(me, fmi3Fatal, "it is broken");
      return fmi3Fatal;
    case DONE:
      break;
  }
  if (me->now.integers[FAULT] == FAULT_CHATS) say(me, fmi3OK, "all is well");
  if (me->now.integers[FAULT] == FAULT_WARNS) say(me, fmi3Warning, "beware");
  return fmi3OK;
}

fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState* state) {
  if (!*state) *state = malloc(sizeof(model));
  memcpy(*state, &((instance*)c)->now, sizeof(model));
  return fmi3OK;
}
fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState state) {
  memcpy(&((instance*)c)->now, state, sizeof(model));
  return fmi3OK;
}
fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState* state) {
  free(*state);
  *state = NULL;
  return c ? fmi3OK : fmi3Error;
}
fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState state, size_t* size) {
  *size = model_size(state);
  return c ? fmi3OK : fmi3Error;
}
fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[], size_t size) {
  memset(bytes, 0, size);
  memcpy(bytes, state, sizeof(model));
  return c ? fmi3OK : fmi3Error;
}
fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte bytes[], size_t size, fmi3FMUState* state) {
  if (size < sizeof(model)) return fmi3Error;
  *state = malloc(sizeof(model));
  memcpy(*state, bytes, sizeof(model));
  return c ? fmi3OK : fmi3Error;
}
