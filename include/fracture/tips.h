/* Room `fracture`: where cracks are, what drives them and how they grow. It knows bonds and particles; probes and the
 * engine call it.
 *
 * Crack tips, followed from sample to sample.
 *
 * A tip starts at the end of a pre-crack inside the body or where the first particle away from every known crack
 * passes damage 0.35. Particles that pass 0.35 and touch (1.5 spacings, reference positions, same body) a
 * particle of a crack, or its start (2.5 spacings), belong to it; particles damaged by a pre-crack at t = 0 belong
 * to none, nor do driven ones. The tip is its farthest particle from the start, the mean of equals that touch each
 * other; of equals apart, as on two branches, one is taken (fracture/places.h). Particles beside the last 2.5 spacings
 * of the pre-crack itself do not count as growth. A crack that started away from all others
 * and is reached by one becomes part of it. In 3D every edge of a pre-crack inside the body is one front: its start
 * is the whole edge. */
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
    real origin[DIM_MAX];         /* where it started [m] */
    real along[DIM_MAX];          /* unit direction of the pre-crack there; the x axis without */
    real edge[DIM_MAX];           /* 3D: half the front's edge, origin -+ edge are its ends; else 0 [m] */
    real place[DIM_MAX];          /* where it is now (reference position) [m] */
    real growth;                  /* |place - origin|, 3D: from the front's edge [m] */
    real joined;                  /* part of it that came at once, by reaching another crack: no speed [m] */
    real first_time;              /* first particle past 0.35; NAN before [s] */
    real start_time, arrest_time; /* growth passed one spacing; last growth; NAN before [s] */
    real speed_max, speed_mean;   /* steepest regression over the window; growth over (arrest - start) [m/s] */
    int64_t particles;            /* that belong to it */
    int64_t ends;                 /* groups of particles, apart from each other, as far within a spacing */
};

struct tips {
    int dim, n;
    struct tip tip[TIPS_MAX];
    real spacing, window; /* [m], [s] */
    int64_t count;        /* particles */
    uint8_t *label;       /* [particles] tip + 1, 0: none, 255: damaged by a pre-crack */
    int64_t samples;
    real *time;   /* [samples] growth of every tip at every sample, for the speeds */
    real *growth; /* [samples][TIPS_MAX], without `joined` */
};

/* Particles whose share `lost` [particles] of damage pre-cracks alone would make, once they have bonds, belong to no
 * crack either. */
void tips_before(struct tips *t, const real *lost);
/* Needs damage of the pre-cracks already on the particles. window [s] of the speed. */
void tips_make(struct tips *t, const struct particles *p, const struct cells *c, const struct crack *crack, int cracks,
               real spacing, real window);
void tips_sample(struct tips *t, const struct particles *p, const struct cells *c, real time);
/* Angle of the chord against the pre-crack's direction, 0..180 [degree]; NAN before it has grown. */
real tip_angle(const struct tip *tip, int dim);
/* Steepness of tip k's growth over the newest window, 0 before there are two samples [m/s]. */
real tips_speed(const struct tips *t, int k);
/* The tip that grew longest, NULL if none has grown. */
const struct tip *tips_longest(const struct tips *t);
/* Number of ends, of all tips, that have grown as far as the longest, within a spacing; 0: none has grown. */
int64_t tips_tied(const struct tips *t);
/* Does a crack run along a plane of symmetry, so that the body has one of its faces? */
bool tip_on_mirror(const struct tips *t, const struct tip *tip, const struct mirror_plane *mirror, int mirrors);
/* What areas depend on beside tips. */
struct tip_surroundings {
    const struct mirror_plane *mirror; /* planes of symmetry */
    int mirrors;
    real section; /* what a length in the plane, a place in line is multiplied with [m], [m^2] */
    real half;    /* half of the damage of particles beside a plane cut [1] */
};
/* Area of the faces that cracks have made, as measured at the last sample [m^2]: along the front of a pre-crack, in
 * strips a spacing wide, how far it has come from there, a spacing being the least, branches left out; of other cracks
 * half the particles; of a crack in a plane of symmetry half of it, as of its energy. */
real tips_area(const struct tips *t, const struct particles *p, const struct tip_surroundings *s);
void tips_free(struct tips *t);
status tips_archive(struct tips *t, struct archive *a);

#endif
