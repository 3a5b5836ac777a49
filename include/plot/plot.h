/* Room `plot`: pictures and comparisons of finished or running runs, made from their files alone, and pictures of
 * scenes before they run. Called by commands.
 *
 * This header declares what the files of `cleave plot` share with each other and with `cleave compare`. */
#ifndef CLEAVE_PLOT
#define CLEAVE_PLOT

#include "data/region.h"
#include "output/history.h"
#include "output/output.h"
#include "output/output_files.h"
#include "plot/colours.h"
#include "plot/gnuplot.h"

/* ---- requests ---------------------------------------------------------------------------------------------------- */

/* Number of panels of a picture: default, largest. */
enum { PANELS = 6, PANELS_MAX = 24 };

/* Directions of a view of a solid: right-handed unit vectors to the right, upwards and towards the viewer. */
struct camera {
    double right[3], up[3], towards[3];
};

/* Isometric view. */
extern const struct camera camera_isometric;

/* Returns the view along a coordinate axis (0 .. 2). side: +1, the viewer is on the side of larger coordinates; -1, on
 * the other. */
struct camera camera_along(int axis, int side);

struct plot_field;

/* Selects the particles of a frame that are drawn: in 3D a slice or an outside view, in 2D all. */
struct projection {
    bool outside;                   /* outside view; else a slice */
    struct camera camera;           /* direction of the outside view */
    int normal;                     /* normal axis of the slice; -1: the thinnest direction of the body */
    bool placed;                    /* `layer` is set */
    double layer;                   /* coordinate of the slice along its normal [m]; default: the slice with the
                                     * largest sum of damage */
    const struct plot_field *field; /* field to be drawn; NULL: only damage, kind and fragment */
    const float *value;             /* [n] values of the field in the current frame */
    bool in_steps;                  /* the frames are those of load steps */
};

/* Options of `cleave plot`. */
struct plot_request {
    const char *folder;      /* folder of the run */
    int panels;              /* number of frames to show, evenly spread; 0: a default, or all frames of a film */
    bool every;              /* show all frames; standard pictures: one file per frame */
    int times;               /* number of entries of `time` */
    double time[PANELS_MAX]; /* show the frames nearest to these times instead [s] */
    const char *field;       /* name of the field; NULL: draw the standard pictures */
    struct projection projection;
    enum picture_format format;
    const char *out; /* output file or folder; NULL: DIR/pictures */
    bool overwrite;  /* replace `out` even if Cleave did not draw it */
};

/* Draws all standard pictures of a run and prints their names. */
status run_pictures(const struct plot_request *r);

/* Draws a picture or film of one field and prints its name and the range of the colours. */
status field_picture(const struct plot_request *r);

/* ---- runs -------------------------------------------------------------------------------------------------------- */

/* Returns true if the folder of a run holds the file `name`. */
bool run_holds(const char *folder, const char *name);

/* Returns the path of frame `number` of a run. */
struct path run_frame_path(const char *folder, int number);

/* Reads frame `number` of a run, as frame_read. */
status run_frame(struct frame *f, const char *folder, int number);

/* The frames of a run and the selected ones. */
struct run_frames {
    int listed;
    struct listed_frame *list; /* [listed] */
    int shown;
    struct listed_frame *show; /* [shown] frames of the panels */
};

/* Lists the frames of a run and selects those that the request asks for. REFUSED for a time outside the range of the
 * frames. Release with run_frames_free. */
status run_frames_choose(struct run_frames *f, const struct plot_request *r);

/* Releases the lists. */
void run_frames_free(struct run_frames *f);

/* Reads all selected frames into an allocated array *f, [frames->shown], released with frames_free. */
status frames_read(struct frame **f, const char *folder, const struct run_frames *frames);

/* Releases n frames and their array. */
void frames_free(struct frame *f, int n);

/* Creates the folder of pictures, DIR/pictures. REFUSED if a link has this name. */
status pictures_folder_make(const char *path);

/* Determines the path of a picture from the option -o: `out` is a file, or a folder in which the file `name` is
 * created. Missing folders are created. REFUSED if the file exists and Cleave did not draw it, unless `overwrite` is
 * set. */
status picture_destination(struct path *path, const char *out, const char *name, bool overwrite);

/* Prints that a picture is not drawn and why, and removes the picture of an earlier command if Cleave drew it. */
status nothing_to_draw(const char *path, const char *why);

enum { TITLE_LENGTH = 256 };
struct cloud;

/* Composes the title `name, method: what` of a picture into title[TITLE_LENGTH]; unknown parts are left out. c: adds
 * the position of its slice and its time; may be NULL. */
void compose_title(char *title, const char *folder, const char *what, const struct cloud *c);

/* Unit for display: displayed value = SI value / factor. */
struct unit {
    double factor;
    char name[8];
};

/* Returns the unit with the SI prefix for which `largest` has one to three digits: microseconds for unit_for(2e-5,
 * "s"). */
struct unit unit_for(double largest, const char *name);

/* Returns a unit of length for values up to `largest`: millimetres between 0.5 mm and 10 m. */
struct unit unit_for_length(double largest);

/* ---- fields ------------------------------------------------------------------------------------------------------ */

/* Range of the colours of a field: from zero; symmetric about zero; from the least value; or one colour for each of a
 * few named values. */
enum field_scale { FROM_ZERO, BOTH_SIGNS, FROM_LEAST, CATEGORY };

/* A scalar field: one component of a field of frames or of a derived field, or the magnitude of a vector. */
struct plot_field {
    const char *name, *stored; /* name of this field; name of the field in the file from which it is computed */
    int component;             /* index of the component; -1: magnitude */
    const char *unit;
    enum field_scale scale;
};

/* Finds a field by name. REFUSED, with the most similar name, if the name is unknown or the field does not exist in
 * this dimension. */
status plot_field_find(const struct plot_field **field, const char *name, int dim);

/* Reads the values of a field, allocated [f->n], at the particles of f, which was read from `path`. Release with
 * memory_free. */
status plot_field_read(float **value, const struct plot_field *field, const struct frame *f, const char *path);

/* ---- maps -------------------------------------------------------------------------------------------------------- */

/* Particles of one frame that are drawn: all particles in 2D; in 3D a slice, or all in an outside view. Arrays are
 * [n]. */
struct cloud {
    int64_t n;
    float *position[DIM_MAX]; /* current position along the axes of the map [m]; position[2], towards the viewer, is
                               * NULL for a flat map */
    float *damage;            /* [1] */
    uint8_t *kind;
    int32_t *fragment;     /* NULL: unknown */
    int32_t fragments;     /* number of fragments: largest index + 1 */
    float *value;          /* values of the field in SI units; NULL: none */
    struct colour *colour; /* colour of each particle for every map; NULL: determined by the map */
    int axis[2], normal;   /* axes of the map, 0 .. 2 for x y z; normal of the slice, -1: no slice */
    struct camera camera;  /* directions of an outside view */
    double layer;          /* coordinate of the slice along its normal [m] */
    double t;              /* time [s] */
    bool in_steps;         /* the frame is that of a load step */
    int64_t step;          /* number of the time step or load step */
    double spacing;        /* spacing of the particles [m] */
    double tall;           /* half height of a particle of a 1D bar [m]; 0: particles are as high as wide */
    float *size;           /* size of the particles and of the material points of coarse cells [m]; NULL: spacing
                            * everywhere */
    bool aligned;          /* nearest neighbours still lie along the axes */
    double from[2], to[2]; /* bounding box of the reference positions [m] */
};

/* Fills the cloud from a frame. projection: NULL for the slice with the largest damage. Release with cloud_free. */
void cloud_make(struct cloud *c, const struct frame *f, const struct projection *projection);

/* Releases the arrays of c. */
void cloud_free(struct cloud *c);

/* Completes a slice from the particles of a frame: chooses the normal and the layer if they are not set, and moves a
 * given layer to the nearest particles. REFUSED if no particle is within one spacing of the given layer. */
status projection_complete(struct projection *projection, const struct frame *f);

/* Returns the particle spacing [m]: the median distance of neighbours in the reference positions of a sample of
 * particles. */
double frame_spacing(const struct frame *f);

/* Quantity that a map shows. */
enum map { MAP_DAMAGE, MAP_KIND, MAP_FRAGMENT, MAP_FIELD, MAP_CATEGORY, MAP_CRACKS };

/* Number of named values that part_colour can distinguish. */
enum { CATEGORIES_MOST = 9 };

/* A named value and its colour. */
struct category {
    struct colour colour;
    char name[NAME_MAX_LENGTH];
};

/* The named values in a set of clouds; `more` further values are not listed. */
struct categories {
    int n, more;
    struct category of[CATEGORIES_MOST];
};
/* Finds the named values of a field that occur in the clouds. Names of bodies and materials are read from the scene in
 * the run's folder. */
void categories_find(struct categories *k, const struct plot_field *field, const char *folder,
                     const struct cloud *cloud, int clouds);

/* Returns the colour of a named value. */
struct colour category_colour(const struct plot_field *field, float value);

/* Rectangle of a map and the options of its display. */
struct view {
    double from[2], to[2];               /* lower left and upper right corner [m] */
    double top;                          /* damage at the upper end of the colour scale */
    const struct plot_field *field;      /* field of MAP_FIELD */
    double low, high;                    /* values of the field at the ends of the colour scale */
    const struct categories *categories; /* named values of MAP_CATEGORY; borrowed */
    int64_t outside;                     /* largest number of particles of a frame outside the rectangle */
    int notches;
    const struct crack *notch; /* [notches] pre-cracks of a plane scene, drawn as lines in maps of damage; borrowed */
};

/* Particles with at least this damage are cracks in MAP_CRACKS; a plane that cuts all bonds of a family across it
 * causes damage 1/2. */
#define CRACK_DAMAGE 0.35

/* Returns the common rectangle of all clouds: the body with a margin. A few particles that are far from the others are
 * left outside. */
struct view view_of(const struct cloud *cloud, int clouds);

/* Sets the field of a view and the values at the ends of its colour scale, by field->scale. Extreme values of a few
 * particles are ignored. */
void view_set_field(struct view *v, const struct plot_field *field, const struct cloud *cloud, int clouds);

/* Returns the colour of particle i in a map. */
struct colour particle_colour(const struct view *v, const struct cloud *c, int64_t i, enum map map);

/* Returns the colour at position `a`, 0 .. 1, of the colour scale of a map. */
struct colour map_colour(const struct view *v, enum map map, double a);

/* Paints the particles of a flat cloud into pixel[height][width], row 0 at the bottom: each on its own square, or disc
 * where the lattice is rotated; each pixel shows the nearest particle. Pixels without a particle are white and
 * transparent. */
void raster_paint(struct colour *pixel, int width, int height, const struct view *view, const struct cloud *c,
                  enum map map);

/* Paints the particles of an outside view into pixel[height][width], row 0 at the bottom: each as a cube; each pixel
 * shows the cube nearest to the viewer. MAP_CRACKS paints the cubes of cracks in front of the faded body. */
void boxes_paint(struct colour *pixel, int width, int height, const struct view *view, const struct cloud *c,
                 enum map map);

/* Output file of a picture. */
struct sheet {
    const char *path;
    enum picture_format format;
};

/* Draws one picture with a panel for each cloud, a common colour scale or key, and `title` above. FAILED if gnuplot
 * fails. */
status maps_draw(struct sheet sheet, const char *title, enum map map, const struct view *view,
                 const struct cloud *cloud, int clouds);

/* ---- curves ------------------------------------------------------------------------------------------------------ */

/* Data of curves over time: one row per sample, sent as the gnuplot data block $data. */
struct series {
    const struct history *h;
    int time;           /* column of the time, or of the number of the load step */
    struct unit second; /* unit of the time; factor 1 without name for load steps */
    enum picture_format format;
};

/* Returns the largest absolute value of a column; 0 if there is none. */
double curves_largest(const struct history *h, int column);

/* Sends the time and column[columns], each divided by its factor, as the data block $data. Long histories are thinned
 * to a few thousand rows that include the last one. */
void curves_send(FILE *to, const struct series *s, const int *column, const double *factor, int columns);

/* Writes the commands for a heading above the picture: `title` and `what`. */
void curves_title(FILE *to, const char *title, const char *what);

/* Writes the commands for the axis of time or load steps below the picture. */
void curves_time_axis(FILE *to, const struct series *s);

/* Draws sif.png: stress-intensity factors over time, and below the spread of the contours. Draws nothing for a run
 * without sif probes. title: as for curves_title. */
status sif_bench_draw(const char *folder, const char *title, const struct series *s);

/* Draws path.png: paths of crack tips from growth probes, with the angle of an experiment if the scene states one.
 * Draws nothing for a run without such probes. */
status paths_draw(const char *folder, const char *title, const struct series *s);

/* Returns true if a run consists of load steps. */
bool run_in_steps(const char *folder);

/* Draws, for a run in load steps, the force over the displacement of each reaction probe, with its peak. */
status load_displacement_draw(struct sheet sheet, const char *title, const struct history *h);

/* Draws, for a run in load steps, the energy release rate over the new crack area (R-curve), with G_c of the
 * materials. */
status r_curve_draw(struct sheet sheet, const char *folder, const char *title, const struct history *h);

/* Draws the pictures of history.csv: crack, energy, sif and path; for load steps also load_displacement and r_curve
 * (names in output/pictures.h). format: one for still pictures. */
status curves_draw(const char *folder, const char *title, enum picture_format format);

/* Draws velocity, stress and damage along a bar (1D) for `frames` frames. */
status profiles_draw(struct sheet sheet, const char *title, const struct frame *frame, int frames);

/* Draws one field along a bar (1D). value[frames]: its values in each frame. */
status field_profiles_draw(struct sheet sheet, const char *title, const struct plot_field *field, float *const *value,
                           const struct frame *frame, int frames);

/* Finds a probe of the run that compares a bar with a closed-form solution and stores its name. Returns false if there
 * is none. */
bool bar_probe(const char *folder, char name[NAME_MAX_LENGTH]);

/* Draws the profiles of such a probe at the frames show[frames]: stress, strain, velocity, and damage if there is any,
 * with the closed-form solution. */
status bar_draw(struct sheet sheet, const char *title, const char *folder, const char *probe,
                const struct listed_frame *show, int frames);

#endif
