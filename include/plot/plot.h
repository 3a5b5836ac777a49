/* Room `plot`: pictures and comparisons of finished or running runs, from their files alone. Commands call it.
 *
 * What the files of `cleave plot` share, and what `cleave compare` shares with them. */
#ifndef CLEAVE_PLOT
#define CLEAVE_PLOT

#include "data/region.h"
#include "plot/gnuplot.h"
#include "output/history.h"
#include "output/output.h"

/* `cleave plot`: words after `cleave`, its own name first. */
status command_plot(int argc, char **argv);

/* Is there a file of this name in the folder of a run? */
bool run_holds(const char *folder, const char *name);
/* Frame `number` of a run. */
status run_frame(struct frame *f, const char *folder, int number);

/* A unit for display: shown = SI / factor. */
struct unit { double factor; char name[8]; };

/* The SI prefix under which `largest` has one to three digits: unit_for(2e-5, "s") is microseconds. */
struct unit unit_for(double largest, const char *name);
/* Millimetres for anything between 0.5 mm and 10 m. */
struct unit unit_for_length(double largest);

/* One frame as a flat map: all particles in 2D, the layer nearest to the middle of the thinnest direction in 3D. */
struct cloud {
    int64_t n;
    float *place[2];                     /* current positions along the two axes of the map [m] */
    float *damage;                       /* [1] */
    uint8_t *kind;
    int32_t *fragment;                   /* NULL: not known */
    int32_t fragments;                   /* numbers of fragments are below */
    int axis[2], normal;                 /* 0..2: x y z; normal -1 in 2D */
    double layer;                        /* where the layer is along the normal [m] */
    double t;                            /* [s] */
    double spacing;                      /* of the particles [m] */
    float *size;                         /* [n] of particles and points of coarse cells; NULL: all that spacing [m] */
    bool aligned;                        /* neighbours still lie along the axes */
};
void cloud_make(struct cloud *c, const struct frame *f);
void cloud_free(struct cloud *c);

/* Distance of neighbouring particles: median over a sample, reference positions [m]. */
double frame_spacing(const struct frame *f);

enum map { MAP_DAMAGE, MAP_KIND, MAP_FRAGMENT };
struct colour { uint8_t red, green, blue, alpha; };
/* Colour of a particle; damage is shown from 0 to `top`. */
struct colour map_colour(enum map map, enum kind kind, double damage, double top);
/* Of a fragment by its number; -1: single particles. */
struct colour fragment_colour(int32_t fragment);

/* Rectangle of the map [m], and how its frames are shown. */
struct view {
    double from[2], to[2];
    double top;                          /* damage at the upper end of the colours */
    int notches;
    const struct crack *notch;           /* pre-cracks of a plane scene, lines where damage is shown; borrowed */
};

/* Paints the particles, each over its own square (or disc where the lattice has turned), the nearest on top, into
 * width x height pixels, row 0 at the bottom; white and transparent where there is no body. */
void raster_paint(struct colour *pixel, int width, int height, const struct view *view, const struct cloud *c,
                  enum map map);

/* One picture with a panel for each cloud, a common colour bar, and `title` above. */
status maps_draw(const char *path, const char *title, enum map map, const struct view *view,
                 const struct cloud *cloud, int clouds);

/* What is drawn over time: one row a sample, sent as the gnuplot data block $data. */
struct series {
    const struct history *h;
    int time;                            /* column */
    struct unit second;
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
status paths_draw(const char *folder, const char *title, const struct history *h);

/* history.csv: crack.png, energy.png, sif.png and path.png (output/pictures.h). */
status curves_draw(const char *folder, const char *title);

/* One-dimensional frames: velocity, stress, damage along the bar. */
status profiles_draw(const char *path, const char *title, const struct frame *frame, int frames);

/* The name of a probe of the run that has compared a bar with a closed form; false if there is none. */
bool bar_probe(const char *folder, char name[NAME_MAX_LENGTH]);
/* Its profiles: stress, strain, velocity (and damage, where there is any) beside the closed form, at these frames. */
status bar_draw(const char *path, const char *title, const char *folder, const char *probe,
                const struct listed_frame *show, int frames);

#endif
