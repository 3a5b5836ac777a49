/* Shading of outside views. */
#ifndef CLEAVE_PLOT_SHADING
#define CLEAVE_PLOT_SHADING

/* Brightness of faces with normal x, y, z. In a view along an axis the only visible face has full brightness, as the
 * colour bar. */
static const double FACE_BRIGHTNESS[3] = {0.74, 0.87, 1};

#endif
