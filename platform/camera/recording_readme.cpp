#include "camera/recording_format.h"

namespace onestroke {

const char* const recording_readme = R"(A recording by onestroke: what a camera saw, and what was found in it.

  onestroke track --camera folder:THIS_FOLDER --catalog THIS_FOLDER/catalog.json
  onestroke run --camera folder:THIS_FOLDER --catalog THIS_FOLDER/catalog.json

play it again, with the same pixels, times, lens and places of the head, and find the same poses.

recording.json   {"onestroke_recording": 1, ...}: the format's version, the program's, the camera, and its pictures a
                 second where it says so (otherwise 0).
catalog.json     The markers: `onestroke marker list --catalog catalog.json`.
pictures.jsonl   A line of JSON a picture, in the order in which they were tracked; each was written after its picture.
pictures/        Pictures that came as JPEG, byte for byte.
pictures.mkv     All others, without loss: FFVHUFF, FFmpeg's HuffYUV, in Matroska. Its own times are rounded; those of
                 pictures.jsonl count.
second.mkv       The right eye's, where there were two cameras; JPEGs are pictures/*_second.jpg.

A line of pictures.jsonl, in one:

  {"sequence": 17,                      the camera's number; where some are missing, so are their pictures
   "start_ns": 0,                       when the first row's exposure began, ns
   "length_ns": 4000000,                for how long a row was exposed
   "readout_ns": 20000000,              from the first row to the last one, top first; 0: all at once. Row v of height H
                                        was exposed from start + v / (H - 1) * readout to that + length
   "T_world_camera": [w, x, y, z, x, y, z],  where the camera was in the middle of the middle row's exposure
   "format": "nv12",                    of the pixels that were tracked: rgb8, gray8, nv12 or yuyv
   "file": "pictures.mkv",
   "frame": 12, "frame_ms": 400,        which of the video's, from 0, and its time there
   "source": "a.png",                   the camera's own name of it, where it has one
   "lens": {"width", "height", "matrix": [fx, fy, cx, cy], "distortion": [k1, k2, p1, p2, k3]},
   "second": {...},                     the right eye's picture, with all of the above
   "record": {"sequence", "time_ns", "T_world_camera", "cost_ns", "markers": [{"id", "name", "state",
     "T_camera_marker", "velocity", "covariance", "cells": [[index, u, v], ...]}]}}

or {"left_out": 3} where the disk or the processor was too slow for so many pictures.

"lens" holds for all lines that follow until another one comes. It is OpenCV's model in pixels, but for pixel centres,
which lie at half-integers: OpenCV's cx and cy are smaller by 0.5. The pixels of nv12 are in the video as yuv420p and
those of yuyv as yuv422p: their chroma is put into planes of its own, and no value is changed. They are BT.601 in
limited range. A JPEG is decoded by libjpeg-turbo to rgb8.

Axes of a camera: x to the right, y down, z ahead, as seen in the picture; millimetres. A pose T_a_b has a unit
quaternion (w, x, y, z) and a translation and maps b to a: p_a = T_a_b p_b. "time_ns" of a record is the time to which
its poses belong, start + (length + readout) / 2. The covariance is 6 x 6, by rows: of a rotation vector (rad) and a
translation (mm), camera axes, both applied after the pose. "velocity" is [x, y, z, x, y, z], rad/s and mm/s. "cells"
are the ring centres that were seen, in pixels; "second_cells" has a bit for each that the right eye's picture shows.
Times are those of the system's monotonic clock, or count from 0 where the camera was a recording itself. Numbers read
back bit for bit.

A recording that was ended by force is whole up to its last line that ends; a video of it plays, but may have to be
read from its start to find a place in it.
)";

}  // namespace onestroke
