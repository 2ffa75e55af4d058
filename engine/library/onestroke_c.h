#pragma once

/* The C interface (C99). What the numbers mean is said in onestroke.h; the structs here have the same fields, of which
 * 0 means the same: zero a struct before filling it.
 *
 * Functions that can fail say why through onestroke_last_error(). One thread at a time uses a tracker. */

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* C has neither namespaces nor `using`: NOLINTBEGIN(readability-identifier-naming,modernize-use-using) */

typedef enum onestroke_status {
  ONESTROKE_OK = 0,
  ONESTROKE_BAD_ARGUMENT = 1, /* A pointer, the picture or the lens is no good. */
  ONESTROKE_FAILED = 2        /* The catalogue is no good, memory has run out, or anything else. */
} onestroke_status;

enum { ONESTROKE_RGB = 0, ONESTROKE_GRAY = 1, ONESTROKE_NV12 = 2, ONESTROKE_YUYV = 3 };
enum { ONESTROKE_MEASURED = 0, ONESTROKE_PREDICTED = 1, ONESTROKE_LOST = 2 };
enum { ONESTROKE_MAX_MARKERS = 16 }; /* In one picture. */

/* Either horizontal_fov_deg, or the rest: pixels as OpenCV's calibration gives them, k1 k2 p1 p2 k3. */
typedef struct onestroke_lens {
  double horizontal_fov_deg;
  double fx, fy, cx, cy;
  double distortion[5];
} onestroke_lens;

typedef struct onestroke_picture {
  const uint8_t* data; /* Top row first; read during onestroke_process() only. */
  size_t stride;       /* Bytes from one row to the next. */
  const uint8_t* uv_data;
  size_t uv_stride;
  int width, height;
  int layout; /* ONESTROKE_RGB ... */
  int64_t exposure_start_ns;
  int64_t exposure_length_ns;
  int64_t readout_ns;
  uint64_t sequence;
} onestroke_picture;

typedef struct onestroke_marker {
  int id;
  int state;          /* ONESTROKE_MEASURED ... */
  int cells_seen;     /* Rings that showed their ink. */
  char name[48];      /* Ends with a zero. */
  double rotation[9]; /* Marker to camera, 3 x 3, row-major. */
  double translation_mm[3];
  double covariance[36];      /* 6 x 6, row-major: rotation (rad), then translation (mm). */
  double angular_velocity[3]; /* rad/s */
  double linear_velocity[3];  /* mm/s */
} onestroke_marker;

typedef struct onestroke_tracker onestroke_tracker;

/* A tracker for the markers of a catalogue, from a file or from JSON text that ends with a zero. independent: not 0
 * where each picture stands alone. NULL where that fails. */
onestroke_tracker* onestroke_create_from_file(const char* catalog_file, const onestroke_lens* lens, int independent);
onestroke_tracker* onestroke_create_from_json(const char* catalog_text, const onestroke_lens* lens, int independent);
/* NULL is let pass. */
void onestroke_destroy(onestroke_tracker* tracker);

/* Finds the markers. Where it fails, there are none. */
onestroke_status onestroke_process(onestroke_tracker* tracker, const onestroke_picture* picture);
/* How many markers the last picture has, at most ONESTROKE_MAX_MARKERS; the first `capacity` of them are written to
 * `markers`, which may be NULL where capacity is 0. */
size_t onestroke_markers(const onestroke_tracker* tracker, onestroke_marker* markers, size_t capacity);
/* Of the last picture: nanoseconds on its clock, the time to which the poses belong. 0 where there is none. */
int64_t onestroke_time_ns(const onestroke_tracker* tracker);

/* One line that says what the last call that failed on this thread did not like; empty where none failed. Good until
 * the next call that fails. Never NULL. */
const char* onestroke_last_error(void);

/* NOLINTEND(readability-identifier-naming,modernize-use-using) */

#ifdef __cplusplus
}
#endif
