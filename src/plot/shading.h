/* Shading of the surfaces in outside views of solids. */
#ifndef CLEAVE_PLOT_SHADING
#define CLEAVE_PLOT_SHADING

/* Factor on the colour of faces with normal along x, y, z in outside views [1]. In a view along an axis the only
 * visible face has full brightness instead, as the colour bar. */
static const double FACE_BRIGHTNESS[3] = {0.74, 0.87, 1};

/* Weight of the colour of a body, mixed with white, where it is drawn faded behind its cracks (MAP_CRACKS) [1]. */
static const double GHOST = 0.45;

#endif
