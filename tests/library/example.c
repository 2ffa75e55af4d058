/* example CATALOG.json PICTURE.ppm FOV: prints the markers in a picture (P6, no comments) of a lens of FOV degrees. */

#include <onestroke/onestroke_c.h>
#include <stdio.h>
#include <stdlib.h>

static uint8_t* read_ppm(const char* name, onestroke_picture* picture) {
  FILE* file = fopen(name, "rb");
  if (file == NULL) return NULL;
  uint8_t* pixels = NULL;
  if (fscanf(file, "P6 %5d %5d 255", &picture->width, &picture->height) == 2 && fgetc(file) != EOF) {
    picture->stride = 3 * (size_t)picture->width;
    const size_t size = picture->stride * (size_t)picture->height;
    pixels = malloc(size);
    if (pixels != NULL && fread(pixels, 1, size, file) != size) {
      free(pixels);
      pixels = NULL;
    }
  }
  fclose(file);
  picture->data = pixels;
  return pixels;
}

int main(int count, char** arguments) {
  if (count != 4) return 2;
  onestroke_picture picture = {0};
  onestroke_lens lens = {0};
  lens.horizontal_fov_deg = atof(arguments[3]);
  uint8_t* pixels = read_ppm(arguments[2], &picture);
  onestroke_tracker* tracker = onestroke_create_from_file(arguments[1], &lens, 0);
  int result = 1;
  if (tracker == NULL || onestroke_process(tracker, &picture) != ONESTROKE_OK) {
    fprintf(stderr, "example: %s\n", onestroke_last_error());
  } else {
    onestroke_marker markers[ONESTROKE_MAX_MARKERS];
    const size_t found = onestroke_markers(tracker, markers, ONESTROKE_MAX_MARKERS);
    for (size_t i = 0; i < found; ++i) {
      const double* t = markers[i].translation_mm;
      printf("%d %s %.2f %.2f %.2f\n", markers[i].id, markers[i].name, t[0], t[1], t[2]);
    }
    result = 0;
  }
  onestroke_destroy(tracker);
  free(pixels);
  return result;
}
