#pragma once

/// What --help teaches. Kept apart from the parsing so that either can be read as a whole.
namespace onestroke::help {

inline constexpr const char* program =
    "onestroke finds sticks of coloured rings in camera pictures and draws over each the 3D model it carries.";

inline constexpr const char* program_footer = R"~(Examples:
  onestroke run                                   the demo: a made-up camera, and a window if there is a display
  onestroke run --camera file:hands.mp4 --fov 62 --catalog markers.db
  onestroke track --camera folder:pictures --fov 35 --catalog markers.db --output poses.jsonl
  onestroke marker import markers.json --catalog markers.db
  onestroke doctor                                what there is of headset, GPU and cameras, and what each lacks
  onestroke track --help                          more about one command

Units: lengths in millimetres, angles in degrees here and in radians in files, times in milliseconds.
Exit codes: 0 done, 1 failed, 2 wrong usage.
Completion: eval "$(onestroke --completion bash)")~";

inline constexpr const char* completion = "Print a script that completes commands and options in this shell";

inline constexpr const char* camera =
    "Where pictures come from: synthetic[:KEY=VALUE,...] (made up), libcamera[:NAME] (one that is connected, by its "
    "id, its model or a part of either), file:VIDEO, folder:DIR";
inline constexpr const char* fov =
    "Horizontal field of view in degrees, 1 to 170: an ideal lens with square pixels, centred. Needed where there is "
    "no "
    "calibration, except by the synthetic camera, which knows its own";
inline constexpr const char* calibration =
    "Calibration of the lens, with distortion, as OpenCV writes it; instead of --fov";
inline constexpr const char* readout =
    "Rolling shutter: milliseconds from the first row's readout to the last row's, top first; 0 for a global shutter. "
    "Default: what the camera says, otherwise 0";
inline constexpr const char* second_camera =
    "The right eye's camera, where --camera is the left eye's, with --rig or --baseline-mm. synthetic alone is the "
    "first one "
    "once more, seen from where the second sits";
inline constexpr const char* side_by_side =
    "The camera's pictures hold both eyes', the left one in their left half; with --rig or --baseline-mm. --fov and "
    "--calibration are a half's";
inline constexpr const char* rig =
    "How two cameras sit, and their lenses: what cv::stereoCalibrate found, in OpenCV's YAML: R and T (x2 = R x1 + T, "
    "in "
    "millimetres as the board's squares were), M1 D1 M2 D2. Where it has R and T alone the lenses are those of an "
    "intrinsics.yml beside it, or --fov, or --calibration";
inline constexpr const char* baseline =
    "Two cameras that look the same way, the second one MM millimetres to the right of the first, 5 to 1000; --fov or "
    "--calibration is both lenses'";
inline constexpr const char* size =
    "Size of a connected camera's pictures. Default: the one that it has nearest to 1280x720";
inline constexpr const char* format =
    "Format of a connected camera: nv12, yuyv, mjpeg or rgb. Default: the one that is the least work, or mjpeg where "
    "more would not pass through USB 2";
inline constexpr const char* rate = "Pictures a second of a connected camera, where it lets that be set";
inline constexpr const char* exposure =
    "Fixed exposure of a connected camera, in milliseconds: short against blur. Default: its own automatic";
inline constexpr const char* gain = "Fixed gain of a connected camera's sensor; 1 is none";
inline constexpr const char* white_balance = "Fixed white balance of a connected camera, in kelvin";
inline constexpr const char* clock_offset =
    "How many milliseconds later than the driver's time of a picture its light was gathered, negative for earlier, as "
    "`onestroke calibrate camera --clock` measures it. Default: 0";
inline constexpr const char* frames = "Stop after N pictures. Default: at the end of the recording, or never";
inline constexpr const char* catalog =
    "The markers: a catalogue made by `onestroke marker import`, or its exchange JSON";

inline constexpr const char* run = "Follow the markers and show their models over the camera's picture";
inline constexpr const char* display =
    "Where to show it: window, openxr (a headset) or offscreen:DIR (numbered pictures). Default: a "
    "window where there is a display, otherwise off-screen";
inline constexpr const char* world =
    "What is seen behind the models in a headset: camera (the camera's picture, drawn), alpha or additive (the world "
    "itself, as the headset shows it under what is drawn), passthrough (the headset's own cameras, by "
    "XR_FB_passthrough), auto (camera; in a headset that cannot cover the world alpha, or else additive). All but "
    "camera draw no picture, and predict models to when they are seen. Default: auto";
inline constexpr const char* wait =
    "With --display openxr: wait for a runtime and a headset that are not there yet, rather than fail";
inline constexpr const char* stereo = "Off-screen: a picture for each eye, side by side";
inline constexpr const char* no_mirror =
    "Headset: no window beside it. Otherwise there is one that shows what the left eye sees and hears keys, where "
    "there "
    "is a screen";
inline constexpr const char* no_fingers = "Show models before the fingers that hold their sticks";
inline constexpr const char* left_handed =
    "The left hand points, cuts and measures, and its model is laid over the right one's";
inline constexpr const char* snapshots =
    "Where snapshots go, each a picture and its numbers in JSON. Default: among the pictures, or for a window the "
    "folder snapshots";
inline constexpr const char* gpu =
    "Which GPU draws: part of its name, or its number in the list that a wrong name prints. Default: a graphics card "
    "before a chip in the processor before the processor itself";
inline constexpr const char* run_catalog =
    "The markers: a catalogue made by `onestroke marker import`, or its exchange JSON. Default: the demo's own";
inline constexpr const char* mode =
    "exposure: the picture stands where the head was when it was taken, so models and picture never slide on each "
    "other; "
    "fresh: the newest picture, models predicted to it. Default: exposure";
inline constexpr const char* seconds = "Stop after S seconds. Default: never";
inline constexpr const char* log =
    "Where the session is written down, so that --replay can show it again; none for nowhere. Default: session.jsonl "
    "among "
    "the pictures, or for a window the ten newest in ~/.local/state/onestroke/sessions";
inline constexpr const char* replay =
    "Show a session again from its log: the same frames with the same poses, and the camera's pictures where it can "
    "give "
    "them again; --camera names another one";
inline constexpr const char* head_camera =
    "How the head carries the camera, as `onestroke calibrate head` wrote it. Default: your own calibration of this "
    "headset and camera, or what is known of the headset";
inline constexpr const char* run_examples = R"(Examples:
  onestroke run
  onestroke run --camera synthetic:noise=2,blur=1,fingers=1,seed=3 --display offscreen:film --frames 300
  onestroke run --camera synthetic:script=overlay,fingers=1
  onestroke run --camera file:hands.mp4 --calibration lens.yaml --catalog markers.db --display window
  onestroke run --second-camera synthetic --baseline-mm 64 --stereo --display offscreen:pair --frames 60
  onestroke run --replay session.jsonl --display offscreen:again

What the made-up camera's hands do, script=: hands (the demo); one for each way of comparing: side, link, mirror, overlay,
section, measure, freeze, snapshot, card, menu; with one stick: turn_x, turn_y, turn_z, still.

Keys in a window, that beside a headset too: L links the two models, mirrors them, parts them again; O lays one over the
other, B by their best fit or by their own frames; C cuts one by the other's stick; M measures; F freezes a model; P
saves a snapshot; I shows what is known of the models; X exchanges the hands; H hides words and figures; R puts the
world's origin where a headset's head is; N opens and closes a menu of all this, Tab goes on in it and Enter picks;
Space pauses; Q or Escape ends.

Without a keyboard: cross the start arms of both sticks until the ring is full, then hold a red tip before what is to be
picked. A headset's controllers: left trigger goes on, right one picks, either opens the menu. Hands without sticks: thumb
and forefinger tapped together do the same.)";

inline constexpr const char* track = "Find the markers' poses and write them, one line of JSON a picture";
inline constexpr const char* track_output = "Where the lines go; replaces the file. Default: standard output";
inline constexpr const char* overlay = "Also write every picture to this folder with what was found drawn into it";
inline constexpr const char* independent =
    "Treat each picture alone, with no memory of the one before: for sets of unrelated pictures";
inline constexpr const char* threads =
    "Threads, 1 to 256, each with pictures of its own, two threads where there are two cameras; more than 1 needs "
    "--independent";
inline constexpr const char* track_examples = R"(Examples:
  onestroke track --camera folder:booth --fov 35 --catalog markers.db --independent --output booth.jsonl
  onestroke track --camera file:turntable.mkv --fov 35 --readout-ms 50 --catalog markers.json --overlay drawn
  onestroke track --camera folder:left --second-camera folder:right --rig stereo.yml --catalog markers.db

Each line: {"image", "time_ns", "ms", "markers": [{"id", "name", "R", "rvec", "t", "covariance", "cells_seen", "state",
"cell_centres"}]}. A pose maps marker to camera: p_camera = R p_marker + t; t in millimetres, rvec in radians; camera axes
x right, y down, z forward; pixel centres at half-integers. Of two cameras the first is meant; "second_cells" are the indices
of the cells that the second one sees.)";

inline constexpr const char* marker = "Keep the catalogue of markers";
inline constexpr const char* import =
    "Add the markers of a JSON file to a catalogue: all of them or, at any error, none";
inline constexpr const char* import_file = "The markers in exchange form; another catalogue will do too";
inline constexpr const char* import_catalog = "The catalogue to add to, an SQLite database; made where it is missing";
inline constexpr const char* replace = "Markers whose id is in the catalogue already take the place of the old";
inline constexpr const char* export_ = "Write a catalogue in exchange form";
inline constexpr const char* export_output = "The file to write; replaces it. Default: standard output";
inline constexpr const char* list = "One line a marker";
inline constexpr const char* show =
    "Everything about one marker: code, geometry, and a picture of its cells in letters";
inline constexpr const char* which = "Its id or its name";
inline constexpr const char* marker_examples = R"(Examples:
  onestroke marker import markers.json --catalog markers.db
  onestroke marker list --catalog markers.db
  onestroke marker show m03 --catalog markers.db
  onestroke marker export --catalog markers.db --output markers.json

Exchange form, lengths in millimetres:
  {"markers": [{"id": 1, "name": "m01", "cells": "RGBRGB...", "model": "bracket.glb",
    "shape": {"kind": "angle", "cells": 36, "pitch": 4.0, "radius": 3.0, "bend_radius": 0.0}}]}
"value": NUMBER may stand for "cells". Other shapes: "line" (no bend_radius), and "stroke" with "vertices": [[x,y,z], ...].
Models are glTF, STL, OBJ or PLY files, their paths from the catalogue's folder. To say more of one:
  "model": {"file": "part.stl", "unit": "in", "up": "y", "fit": 60,
    "name": "Bracket", "version": "v2", "notes": {"material": "6061-T6"}}
"unit": "m", "cm", "mm", "in" or "ft"; "up": "x", "y" or "z". Usual are metres and y up in glTF, millimetres and y up in OBJ,
millimetres and z up in STL and PLY. "fit" makes the longest side so many millimetres; otherwise a model has its size.
"notes" are keys and texts of your own, in the order in which they are shown.)";

inline constexpr const char* calibrate = "Find out how things sit that the program must know";
inline constexpr const char* calibrate_head =
    "How the headset carries its camera, from a marker that lies still and a head that moves";
inline constexpr const char* calibrate_display = "The headset";
inline constexpr const char* calibrate_output =
    "The file to write, for `onestroke run --head-camera`; replaces it. A headset's calibration is also kept for "
    "`onestroke run` to find";
inline constexpr const char* calibrate_seconds = "Stop after S seconds. Default: when the head has turned enough";
inline constexpr const char* head_poses =
    "For pictures that were taken before: where the head was then, a line of JSON a pose";
inline constexpr const char* calibrate_replay =
    "From the log of a session with a headset, in which the marker lay still, instead of a camera";
inline constexpr const char* headset = "What the headset of a recording is called, to keep its calibration";
inline constexpr const char* calibrate_examples = R"(Examples:
  onestroke calibrate head --camera synthetic:live=1 --catalog markers.db --output head.json
  onestroke calibrate head --camera folder:pictures --fov 90 --catalog markers.db --head-poses poses.jsonl --output head.json
  onestroke calibrate head --replay session.jsonl --output head.json

Lay a marker down in good light, put the headset on, and with the marker in sight turn your head slowly: left and right, up
and down, towards either shoulder, also from other places. Each line of --head-poses is
  {"time_ns": 123456789, "T_world_head": [w, x, y, z, x, y, z]}
or has the "image" that it belongs to in place of "time_ns": a unit quaternion and millimetres, from the head's axes
(x right, y down, z forward, as the eyes look) to any that stand still.)";

inline constexpr const char* calibrate_camera = "What is not known of a camera";
inline constexpr const char* calibrate_clock =
    "How much later than its time says a picture was exposed, from a marker that lies still and a head that turns to "
    "and "
    "fro";
inline constexpr const char* calibrate_camera_examples = R"(Examples:
  onestroke calibrate camera --clock --camera libcamera --exposure-ms 4 --fov 90 --catalog markers.db
  onestroke calibrate camera --clock --camera folder:recording --catalog markers.db

Lay a marker down in good light, put the headset on, and with the marker in sight turn your head to and fro, about once a
second, for ten seconds. A folder that `onestroke run --record` made says itself where the head was.)";

inline constexpr const char* doctor = "Say what there is of headset, GPU, displays and cameras, and what each lacks";
inline constexpr const char* doctor_json = "As JSON, for programs";

}  // namespace onestroke::help
