/* Room `fracture`: positions, driving forces and growth of cracks. The room uses bonds and particles; probes and the
 * engine use it.
 *
 * This header: crack tips, tracked from sample to sample.
 *
 * A tip starts at the end of a pre-crack inside the body, or where a particle away from all known cracks exceeds damage
 * 0.35. Particles that exceed 0.35 and touch (1.5 spacings, reference positions, same body) a particle of a crack, or
 * its start (2.5 spacings), belong to the crack; particles damaged by a pre-crack at t = 0 and driven particles belong
 * to none. The tip is at the farthest particle of the crack from the start, at the mean of several equally far ones
 * that touch each other; of equally far ones in separate groups, as on two branches, one group is chosen
 * (fracture/places.h). Particles beside the last 2.5 spacings of the pre-crack do not count as growth. A crack that
 * started away from all others and is reached by another becomes part of it. In 3D every edge of a pre-crack inside the
 * body is one front, whose start is the whole edge. */
#ifndef CLEAVE_TIPS
#define CLEAVE_TIPS

#include "base/archive.h"
#include "data/cells.h"
#include "data/particles.h"
#include "data/region.h"

#define TIP_DAMAGE 0.35
enum { TIPS_MAX = 64 };

struct tip {
    bool from_crack; /* starts at the end of a pre-crack */
    int body;
    real origin[DIM_MAX]; /* start [m] */
    real along[DIM_MAX];  /* unit direction of the pre-crack at the start; without a pre-crack the x axis */
    real edge[DIM_MAX];   /* 3D: half the edge of the front, origin -+ edge are its ends; else 0 [m] */
    real place[DIM_MAX];  /* present reference position [m] */
    real growth;          /* distance from the start, 3D: from the edge of the front [m] */
    real joined;          /* part of the growth by joining another crack, which has no speed [m] */
    real first_time;      /* time of the first particle above 0.35 [s]; NAN: none so far */
    /* time when growth exceeded one spacing; time of the last growth [s]; NAN: none so far */
    real start_time, arrest_time;
    /* largest slope of the regression over the window; growth over (arrest - start) [m/s] */
    real speed_max, speed_mean;
    int64_t particles; /* number of its particles */
    int64_t ends;      /* separate groups of particles that are equally far within a spacing */
};

struct tips {
    int dim, n;
    struct tip tip[TIPS_MAX];
    real spacing, window; /* spacing of the particles [m], window of the speed [s] */
    int64_t count;        /* number of particles */
    uint8_t *label;       /* [particles] tip + 1; 0: no crack, 255: damaged by a pre-crack */
    int64_t samples;
    real *time;   /* [samples] time of each sample [s] */
    real *growth; /* [samples][TIPS_MAX] growth of every tip, without `joined` [m] */
};

/* Excludes the particles that slits damage from all cracks. lost: [particles] share of damage by pre-cracks alone, once
 * the particles have bonds [1]. */
void tips_before(struct tips *t, const real *lost);

/* Finds the tips of pre-cracks, whose damage the particles must already have. c: kept by reference; window: of the
 * speed [s]. */
void tips_make(struct tips *t, const struct particles *p, const struct cells *c, const struct crack *crack, int cracks,
               real spacing, real window);

/* Updates all tips from the damage of the particles at time `time` [s]. */
void tips_sample(struct tips *t, const struct particles *p, const struct cells *c, real time);

/* Returns the angle between the chord from the start to the tip and the direction of the pre-crack, 0..180 [degree];
 * NAN before the first growth. */
real tip_angle(const struct tip *tip, int dim);

/* Returns the slope of the growth of tip k over the last window [m/s]; 0 before there are two samples. */
real tips_speed(const struct tips *t, int k);

/* Returns the tip with the largest growth, NULL if none has grown. */
const struct tip *tips_longest(const struct tips *t);

/* Returns the number of ends, over all tips, whose growth equals the largest within a spacing; 0 if none has grown. */
int64_t tips_tied(const struct tips *t);

/* Returns true if a crack grows along a plane of symmetry, so that the body has only one of its faces. */
bool tip_on_mirror(const struct tips *t, const struct tip *tip, const struct mirror_plane *mirror, int mirrors);

/* Quantities besides tips on which areas of cracks depend. */
struct tip_surroundings {
    const struct mirror_plane *mirror; /* [mirrors] planes of symmetry */
    int mirrors;
    real section; /* factor of a length in the plane, of a point in 1D [m], [m^2] */
    real half;    /* half of the damage of particles beside a plane cut [1] */
};

/* Returns the area of the faces that cracks have made, at the last sample [m^2]. Along the front of a pre-crack: growth
 * in strips one spacing wide, at least one spacing, without branches; of other cracks: half of their particles; of a
 * crack in a plane of symmetry: half, like its energy. */
real tips_area(const struct tips *t, const struct particles *p, const struct tip_surroundings *s);

/* Releases all arrays. */
void tips_free(struct tips *t);

/* Saves or restores tips, labels and recorded samples. */
status tips_archive(struct tips *t, struct archive *a);

#endif
