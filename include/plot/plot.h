/* Room `plot`: pictures and comparisons of finished or running runs, from their files alone; and of scenes before they
 * run. Commands call it.
 *
 * What the files of `cleave plot` share, and what `cleave compare` shares with them. */
#ifndef CLEAVE_PLOT
#define CLEAVE_PLOT

#include "data/region.h"
#include "output/history.h"
#include "output/output.h"
#include "output/output_files.h"
#include "plot/colours.h"
#include "plot/gnuplot.h"

/* ---- what is asked for ------------------------------------------------------------------------------------------- */

enum { PANELS = 6, PANELS_MAX = 24 };

/* Directions of a view in space: unit vectors to the right, upwards and to the viewer. */
struct camera {
    double right[3], up[3], towards[3];
};
extern const struct camera camera_isometric;
/* Along an axis; side: +1, the viewer is on its upper side. */
struct camera camera_along(int axis, int side);

struct plot_field;
/* What of a frame is drawn: in space a slice or what is seen from outside, in the plane everything. */
struct projection {
    bool outside;         /* else a slice */
    struct camera camera; /* of `outside` */
    int normal;           /* of the slice; -1: the thinnest direction */
    bool placed;
    double layer;                   /* where it is [m]; else where most damage is */
    const struct plot_field *field; /* NULL: none but damage, kind and fragment */
    const float *value;             /* its values in the frame at hand */
    bool in_steps;                  /* frames are those of load steps */
};

struct plot_request {
    const char *folder;
    int panels; /* frames evenly spread; 0: as many as suit, all of a film */
    bool every; /* all frames; of standard pictures one picture each */
    int times;
    double time[PANELS_MAX]; /* the nearest frames instead [s] */
    const char *field;       /* NULL: the standard pictures */
    struct projection projection;
    enum picture_format format;
    const char *out; /* file or folder; NULL: DIR/pictures */
    bool overwrite;  /* `out` may be a file that Cleave has not drawn */
};

/* All pictures of a run, or one of a field; what was made is printed. */
status run_pictures(const struct plot_request *r);
status field_picture(const struct plot_request *r);

/* ---- runs -------------------------------------------------------------------------------------------------------- */

/* Is there a file of this name in the folder of a run? */
bool run_holds(const char *folder, const char *name);
/* The file of a frame, and frame `number` of a run. */
struct path run_frame_path(const char *folder, int number);
status run_frame(struct frame *f, const char *folder, int number);

struct run_frames {
    int listed;
    struct listed_frame *list; /* [listed] */
    int shown;
    struct listed_frame *show; /* [shown] frames of the panels */
};
/* The frames of a run, and those that the request shows. */
status run_frames_choose(struct run_frames *f, const struct plot_request *r);
void run_frames_free(struct run_frames *f);
/* All frames that are shown. */
status frames_read(struct frame **f, const char *folder, const struct run_frames *frames);
void frames_free(struct frame *f, int n);

/* DIR/pictures. REFUSED where it is a link. */
status pictures_folder_make(const char *path);
/* Finds the file that -o names, or one of this name in the folder that it names, and makes missing folders. REFUSED if
 * the file is there already and is no picture of Cleave, unless `overwrite` is set. */
status picture_destination(struct path *path, const char *out, const char *name, bool overwrite);
/* Prints why a picture is not drawn, and removes the picture of Cleave that an earlier command has left there. */
status nothing_to_draw(const char *path, const char *why);

enum { TITLE_LENGTH = 256 };
struct cloud;
/* `name, method: what`, with the slice of c (NULL: none); parts that are unknown are left out. */
void compose_title(char *title, const char *folder, const char *what, const struct cloud *c);

/* A unit for display: shown = SI / factor. */
struct unit {
    double factor;
    char name[8];
};

/* The SI prefix under which `largest` has one to three digits: unit_for(2e-5, "s") is microseconds. */
struct unit unit_for(double largest, const char *name);
/* Millimetres for anything between 0.5 mm and 10 m. */
struct unit unit_for_length(double largest);

/* ---- fields ------------------------------------------------------------------------------------------------------ */

/* Colours of a field: from zero on; as far below it as above; from its least value; or one for each of a few values,
 * which are names. */
enum field_scale { FROM_ZERO, BOTH_SIGNS, FROM_LEAST, CATEGORY };

/* One number a particle: a component of what a frame holds or what follows from it, or the length of a vector. */
struct plot_field {
    const char *name, *stored; /* of the field, of that in frames */
    int component;             /* -1: the length */
    const char *unit;
    enum field_scale scale;
};
/* REFUSED with the nearest name for an unknown one, or one that runs of this dimension do not have. */
status plot_field_find(const struct plot_field **field, const char *name, int dim);
/* Its values [f->n] of a frame that was read from `path`; freed with memory_free. */
status plot_field_read(float **value, const struct plot_field *field, const struct frame *f, const char *path);

/* ---- maps -------------------------------------------------------------------------------------------------------- */

/* One frame as a map: all particles in 2D; in 3D a slice, or all of them as seen from outside. */
struct cloud {
    int64_t n;
    float *place[DIM_MAX]; /* current positions along the axes of the map [m]; [2] NULL: it is flat, else
                            * towards the viewer */
    float *damage;         /* [1] */
    uint8_t *kind;
    int32_t *fragment;     /* NULL: not known */
    int32_t fragments;     /* numbers of fragments are below */
    float *value;          /* of the field [SI]; NULL: none */
    struct colour *colour; /* of each particle, whatever the map; NULL: by the map */
    int axis[2], normal;   /* 0..2: x y z; normal -1: no slice */
    struct camera camera;  /* of a map that is not flat */
    double layer;          /* where the layer is along the normal [m] */
    double t;              /* [s] */
    bool in_steps;
    int64_t step;          /* is it that of a load step, and of which? */
    double spacing;        /* of the particles [m] */
    double tall;           /* half height of a particle of a bar [m]; 0: as wide as high */
    float *size;           /* [n] of particles and points of coarse cells; NULL: all that spacing [m] */
    bool aligned;          /* neighbours still lie along the axes */
    double from[2], to[2]; /* box round reference positions [m] */
};
/* `look` NULL: the slice with most damage. */
void cloud_make(struct cloud *c, const struct frame *f, const struct projection *projection);
void cloud_free(struct cloud *c);
/* The slice that a look leaves open, by the particles of a frame: normal and place. REFUSED where no particle is near
 * the place that it names. */
status projection_complete(struct projection *projection, const struct frame *f);

/* Distance of neighbouring particles: median over a sample, reference positions [m]. */
double frame_spacing(const struct frame *f);

enum map { MAP_DAMAGE, MAP_KIND, MAP_FRAGMENT, MAP_FIELD, MAP_CATEGORY, MAP_CRACKS };

/* Values of a field of names that are seen: no more than part_colour can tell apart. */
enum { CATEGORIES_MOST = 9 };
struct category {
    struct colour colour;
    char name[NAME_MAX_LENGTH];
};
struct categories {
    int n, more;
    struct category of[CATEGORIES_MOST];
}; /* more: not listed */
/* Those of the clouds, with the names of the scene in the run's folder. */
void categories_find(struct categories *k, const struct plot_field *field, const char *folder,
                     const struct cloud *cloud, int clouds);
struct colour category_colour(const struct plot_field *field, float value);

/* Rectangle of the map [m], and how its frames are shown. */
struct view {
    double from[2], to[2];
    double top;                     /* damage at the upper end of the colours */
    const struct plot_field *field; /* of MAP_FIELD, and the values at the ends of its colours */
    double low, high;
    const struct categories *categories; /* of MAP_CATEGORY; borrowed */
    int64_t outside;                     /* particles that are not in the rectangle, in the frame that has most */
    int notches;
    const struct crack *notch; /* pre-cracks of a plane scene, lines where damage is shown; borrowed */
};
/* Particles of the cracks of MAP_CRACKS: damage that a plane through a whole family of bonds makes is a half. */
#define CRACK_DAMAGE 0.35

/* The rectangle of all clouds: that of the body with a margin; what few particles fly further is left out. */
struct view view_of(const struct cloud *cloud, int clouds);
/* Colours of a field: from zero, or as far below zero as above it where it has a sign; extreme values of few particles
 * do not count. */
void view_set_field(struct view *v, const struct plot_field *field, const struct cloud *cloud, int clouds);
/* Colour of particle i. */
struct colour particle_colour(const struct view *v, const struct cloud *c, int64_t i, enum map map);
/* `a` 0..1 of the colours of a map. */
struct colour map_colour(const struct view *v, enum map map, double a);

/* Paints the particles, each over its own square (or disc where the lattice has turned), the nearest on top, into
 * width x height pixels, row 0 at the bottom; white and transparent where there is no body. */
void raster_paint(struct colour *pixel, int width, int height, const struct view *view, const struct cloud *c,
                  enum map map);
/* The same of a cloud that is not flat: cubes, the nearest to the viewer on top. Of MAP_CRACKS those of the cracks, in
 * front of the faded rest. */
void boxes_paint(struct colour *pixel, int width, int height, const struct view *view, const struct cloud *c,
                 enum map map);

/* A format and the pixels of a panel that is to be so wide; 0: as suits. */
struct sheet {
    const char *path;
    enum picture_format format;
};
/* One picture with a panel for each cloud, a common colour bar, and `title` above. */
status maps_draw(struct sheet sheet, const char *title, enum map map, const struct view *view,
                 const struct cloud *cloud, int clouds);

/* ---- curves ------------------------------------------------------------------------------------------------------ */

/* What is drawn over time: one row a sample, sent as the gnuplot data block $data. */
struct series {
    const struct history *h;
    int time;           /* column; of a run in load steps that of their numbers */
    struct unit second; /* factor 1, no name, of load steps */
    enum picture_format format;
};
/* Largest |value| of a column; 0 where there is none. */
double curves_largest(const struct history *h, int column);
/* Sends `columns` over time, each divided by its factor; some thousand rows at most, the last one always. */
void curves_send(FILE *to, const struct series *s, const int *column, const double *factor, int columns);
/* `title` and `what` above the picture; the axis of time below it. */
void curves_title(FILE *to, const char *title, const char *what);
void curves_time_axis(FILE *to, const struct series *s);

/* sif.png: stress-intensity factors over time, below how far contours differ; nothing without sif probes. */
status sif_bench_draw(const char *folder, const char *title, const struct series *s);
/* path.png: the paths of tips that growth probes measured, beside the angle of an experiment where the scene
 * tells one; nothing without such probes. */
status paths_draw(const char *folder, const char *title, const struct series *s);

/* Has a run gone in load steps? */
bool run_in_steps(const char *folder);
/* Of load steps: force over displacement of each reaction probe, with its peak; release rate over the new area of
 * cracks, beside G_c. */
status load_displacement_draw(struct sheet sheet, const char *title, const struct history *h);
status r_curve_draw(struct sheet sheet, const char *folder, const char *title, const struct history *h);

/* history.csv: crack.png, energy.png, sif.png and path.png (output/pictures.h), in any format of stills; of load steps
 * load_displacement.png and r_curve.png. */
status curves_draw(const char *folder, const char *title, enum picture_format format);

/* One-dimensional frames: velocity, stress, damage along the bar; of a field that alone, with its
 * values [frames]. */
status profiles_draw(struct sheet sheet, const char *title, const struct frame *frame, int frames);
status field_profiles_draw(struct sheet sheet, const char *title, const struct plot_field *field, float *const *value,
                           const struct frame *frame, int frames);

/* The name of a probe of the run that has compared a bar with a closed form; false if there is none. */
bool bar_probe(const char *folder, char name[NAME_MAX_LENGTH]);
/* Its profiles: stress, strain, velocity (and damage, where there is any) beside the closed form, at these frames. */
status bar_draw(struct sheet sheet, const char *title, const char *folder, const char *probe,
                const struct listed_frame *show, int frames);

#endif
