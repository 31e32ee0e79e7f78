/* SPDX-License-Identifier: MIT
 *
 * Control code of the urban example: a vehicle that wanders through the streets of a city by its laser
 * scanner alone. It keeps to the right-hand side of the street, turns into side streets at random,
 * drives around obstacles and turns on the spot in a dead end.
 *
 * Every step looks for a gap, in the manner of the vector field histogram (Borenstein, Koren: The vector
 * field histogram, IEEE Trans. Robotics and Automation 7(3), 1991), but with the true width of the vehicle:
 *
 *   1. detect       the scan becomes at most one obstacle point per sector, in the frame of the vehicle
 *   2. prefer       a heading: along the wall on the right, or into a side street
 *   3. find a gap   the heading near the preferred one along which the vehicle, as a disc, gets far
 *   4. drive        towards it, as fast as the free distance allows; or turn on the spot when there is none
 *
 * Frames follow ROS REP-103: x forward, y left, angles counter-clockwise. All units are SI.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "muro_controller.h"
#include "muro_elementary.h" /* sines and the like with equal bits on every machine */

#define PI 3.14159265358979323846
#define DEGREES (PI / 180)

enum { SECTORS = 120, HEADINGS = 41 };

/* The vehicle as a disc: half its width, and a margin for objects that the scan does not show. */
static const double radius = 0.30;           /* m */
static const double horizon = 5.0;           /* m; longer free distances count as this */
static const double min_free_distance = 1.0; /* m; below this a heading is blocked */
static const double max_turn_rate = 1.2;     /* rad/s */
static const double deceleration = 0.5;      /* m/s^2, with which it must be able to stop */
static const double reaction = 0.8;          /* s */
static const double max_heading = 100 * DEGREES;
static const double detour_cost = 0.35;   /* of the horizon, for a heading 90 degrees off the preferred one */
static const double lane = 1.2;           /* m from the wall on the right */
static const double lane_lookahead = 1.5; /* m */
static const double side_street = 4.6;    /* m; a free distance to the side that exceeds the width of a street */
static const double side_right = -90 * DEGREES, side_left = 110 * DEGREES; /* where a side street is visible */

/* The state between steps: the block that muro saves and restores. */
typedef struct {
  double speed;         /* m/s, at most */
  double laser_x;       /* m, the scanner in front of the centre of the vehicle */
  double period;        /* s between steps */
  uint64_t rays;        /* number of rays of the scanner */
  uint64_t random;      /* state of the random numbers */
  double desired_turn;  /* at a side street: -1 right, 0 pass, +1 left */
  double desired_until; /* s */
  double turn;          /* rad remaining of a turn into a side street, else 0 */
  double spin;          /* -1 or +1 while turning on the spot, else 0 */
  double spun_angle;    /* rad, so far on the spot */
} wander;

enum { RANGES, MIN_ANGLE, ANGLE_INCREMENT, MAX_RANGE, INPUTS };
static const muro_port inputs[INPUTS] = {
    {"ranges", "m", 0, MURO_PORT_OPTIONAL}, /* without a laser it stands still */
    {"laser.min_angle", "rad", 1, MURO_PORT_OPTIONAL},
    {"laser.angle_increment", "rad", 1, MURO_PORT_OPTIONAL},
    {"laser.max_range", "m", 1, MURO_PORT_OPTIONAL},
};
static const muro_port outputs[] = {{"command.twist", "m/s, rad/s", 6, 0}}; /* vx vy vz wx wy wz */

/* ---------------------------------------------------------------- obstacles */

typedef struct {
  double x, y; /* m */
} point;

/* The nearest obstacle in each sector that has one. */
typedef struct {
  int count;
  point points[SECTORS];
} obstacles;

static void detect_obstacles(obstacles* seen, const double* const* in, uint32_t rays, double laser_x) {
  const double* ranges = in[RANGES];
  const double max_range = *in[MAX_RANGE];
  uint32_t ray = 0;
  seen->count = 0;
  for (uint32_t sector = 0; sector < SECTORS; ++sector) {
    const uint32_t end = (uint32_t)((uint64_t)rays * (sector + 1) / SECTORS);
    double nearest = max_range;
    uint32_t nearest_ray = ray;
    for (; ray < end; ++ray) {
      if (ranges[ray] > 0 && ranges[ray] < nearest) { /* 0 is a lost reading */
        nearest = ranges[ray];
        nearest_ray = ray;
      }
    }
    if (nearest < max_range) {
      const double angle = *in[MIN_ANGLE] + nearest_ray * *in[ANGLE_INCREMENT];
      double sine, cosine;
      muro_sincos(angle, &sine, &cosine);
      seen->points[seen->count++] = (point){laser_x + nearest * cosine, nearest * sine};
    }
  }
}

/* Returns the distance (m, at most the horizon) that the disc can move in the direction `heading` (rad). A point
 * inside the disc blocks it only when it lies ahead. */
static double free_distance(const obstacles* seen, double heading) {
  double sine, cosine, distance = horizon;
  muro_sincos(heading, &sine, &cosine);
  for (int i = 0; i < seen->count; ++i) {
    const point p = seen->points[i];
    const double along = p.x * cosine + p.y * sine;
    const double across = p.y * cosine - p.x * sine;
    const double rest = radius * radius - across * across;
    if (along <= 0 || rest <= 0) continue;
    const double reach = fmax(0, along - sqrt(rest));
    const int behind_shoulder = reach == 0 && along < 0.3 * radius;
    if (reach < distance && !behind_shoulder) distance = reach;
  }
  return distance;
}

/* Finds the straight wall on the right, by linear regression y = offset + slope * x. Returns 0 when there is none. */
static int find_right_wall(const obstacles* seen, double* direction, double* distance) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0, syy = 0, first = HUGE_VAL, last = -HUGE_VAL;
  for (int i = 0; i < seen->count; ++i) {
    const point p = seen->points[i];
    if (p.y > -0.2 || p.y < -4.0 || p.x < -1.0 || p.x > 2.0) continue;
    n += 1, sx += p.x, sy += p.y, sxx += p.x * p.x, sxy += p.x * p.y, syy += p.y * p.y;
    first = fmin(first, p.x), last = fmax(last, p.x);
  }
  if (n < 8 || last - first < 0.7) return 0;
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  const double offset = (sy - slope * sx) / n;
  const double error = sqrt(fmax(0, syy - offset * sy - slope * sxy) / n); /* rms, m */
  if (error > 0.05 || fabs(slope) > 1) return 0;
  *direction = muro_atan(slope);
  *distance = -offset / sqrt(1 + slope * slope);
  return 1;
}

/* ---------------------------------------------------------------- heading */

/* Returns a uniform number in [0, 1): splitmix64 (Steele, Lea, Flood: Fast splittable pseudorandom number generators,
 * 2014). */
static double draw(wander* w) {
  uint64_t z = (w->random += 0x9E3779B97F4A7C15ull);
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ull;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBull;
  return (double)((z ^ (z >> 31)) >> 11) * 0x1.0p-53;
}

static double clamp_magnitude(double value, double max) { return fmax(-max, fmin(max, value)); }

/* Returns the heading (rad) for a way without obstacles. */
static double preferred_heading(wander* w, const obstacles* seen, double time) {
  if (time >= w->desired_until) {
    const double dice = draw(w);
    w->desired_turn = dice < 0.4 ? -1 : dice < 0.8 ? 1 : 0;
    w->desired_until = time + 4 + 8 * draw(w);
  }
  double direction = 0, distance = lane;
  const int wall = find_right_wall(seen, &direction, &distance);
  const int along_street = !wall || fabs(direction) < 15 * DEGREES;
  if (w->turn == 0 && w->desired_turn != 0 && along_street &&
      free_distance(seen, w->desired_turn < 0 ? side_right : side_left) >= side_street) {
    w->turn = w->desired_turn * 90 * DEGREES;
    w->desired_turn = 0;
  }
  if (w->turn != 0) return w->turn;
  return direction + muro_atan2(lane - distance, lane_lookahead); /* straight on without a wall */
}

/* Returns the heading with the best trade-off of free distance and detour; `free` gets its free distance. */
static double best_heading(const obstacles* seen, double preferred, double* free) {
  double best = clamp_magnitude(preferred, max_heading), best_score = -HUGE_VAL;
  for (int i = -1; i < HEADINGS; ++i) {
    const double heading = i < 0 ? best : max_heading * (2.0 * i / (HEADINGS - 1) - 1);
    const double reach = free_distance(seen, heading);
    const double score = reach / horizon - detour_cost * fabs(heading - preferred) / (90 * DEGREES);
    if (score > best_score) {
      best_score = score;
      best = heading;
      *free = reach;
    }
  }
  return best;
}

/* ---------------------------------------------------------------- motion */

/* Turns on the spot, to one side, until the way ahead is free; the longer it takes, the shorter a free distance
 * suffices. */
static void spin(wander* w, const obstacles* seen, double* twist) {
  const double required = fmax(min_free_distance, 2.5 * (1 - w->spun_angle / (2 * PI)));
  twist[0] = 0;
  twist[5] = max_turn_rate * w->spin;
  w->spun_angle += max_turn_rate * w->period;
  if (free_distance(seen, 0) >= required) w->spin = 0;
}

static void drive(wander* w, const obstacles* seen, double heading, double* twist) {
  const double ahead = free_distance(seen, 0);
  const double stopping = deceleration * (sqrt(reaction * reaction + 2 * ahead / deceleration) - reaction);
  const double aligned = fmax(0, 1 - fabs(heading) / (80 * DEGREES));
  twist[0] = fmin(w->speed * aligned, stopping);
  twist[5] = clamp_magnitude(1.5 * heading, max_turn_rate);
  if (w->turn != 0) { /* dead reckoning */
    w->turn -= twist[5] * w->period;
    if (fabs(w->turn) < 10 * DEGREES) w->turn = 0;
  }
}

static int step(void* state, const muro_controller_step* now, char* error, size_t error_size) {
  (void)error, (void)error_size;
  wander* w = state;
  double* twist = now->outputs[0];
  obstacles seen;
  if (w->rays == 0) {
    twist[0] = twist[5] = 0;
    return 0;
  }
  detect_obstacles(&seen, now->inputs, (uint32_t)w->rays, w->laser_x);

  if (w->spin == 0) {
    double free = 0;
    const double heading = best_heading(&seen, preferred_heading(w, &seen, now->time), &free);
    if (free >= min_free_distance) {
      drive(w, &seen, heading, twist);
      return 0;
    }
    w->spin = draw(w) < 0.5 ? -1 : 1;
    w->spun_angle = 0;
    w->turn = 0;
  }
  spin(w, &seen, twist);
  return 0;
}

/* ---------------------------------------------------------------- interface to muro */

/* "name=value" sets *number; returns 1 when `argument` has this name and a value from `min` to `max`. */
static int parse_argument(const char* argument, const char* name, double min, double max, double* number) {
  const size_t length = strlen(name);
  if (strncmp(argument, name, length) != 0 || argument[length] != '=') return 0;
  char* end;
  const double value = strtod(argument + length + 1, &end);
  if (end == argument + length + 1 || *end != 0 || !(value >= min && value <= max)) return 0;
  *number = value;
  return 1;
}

static int create(void* state, const muro_controller_setup* setup, char* error, size_t error_size) {
  wander* w = state;
  w->speed = 0.7;
  w->laser_x = 0.1; /* as on examples/models/rover.urdf */
  w->period = setup->period;
  w->random = setup->seed;
  w->rays = setup->input_sizes[RANGES];
  for (int i = 0; i < INPUTS; ++i) {
    if (w->rays == 0 || setup->input_sizes[i] > 0) continue;
    snprintf(error, error_size, "there are ranges, but no `%s` to go with them", inputs[i].name);
    return 1;
  }
  for (const char* const* a = setup->arguments; *a; ++a) {
    if (parse_argument(*a, "speed", 0.1, 2, &w->speed) || parse_argument(*a, "laser_x", -1, 1, &w->laser_x)) continue;
    snprintf(error, error_size, "argument `%s` is none of: speed=0.1..2 (m/s), laser_x=-1..1 (m)", *a);
    return 1;
  }
  return 0;
}

static const muro_controller_table table = {
    .abi = MURO_CONTROLLER_ABI,
    .table_size = sizeof(muro_controller_table),
    .name = "wander",
    .version = "1.0.0",
    .summary = "Drives through streets by laser, keeps right, avoids what it sees",
    .inputs = inputs,
    .input_count = INPUTS,
    .outputs = outputs,
    .output_count = 1,
    .state_size = sizeof(wander),
    .create = create,
    .step = step,
};

const muro_controller_table* muro_controller(void) { return &table; }
