/* Adds hints at loads whose sign, and at settings whose size, is probably not intended. */
#include <math.h>

#include "check_parts.h"
#include "probes/probes_part.h"

#define FRICTION_MOST 3.0   /* coefficient; dry metals in vacuum have 1 to 2 */
#define EARTH 9.81          /* gravity on the Earth [m/s^2] */
#define GRAVITY_MOST 1000.0 /* largest gravity divided by EARTH [1]; geotechnical centrifuges have up to 300 */
#define DAMPING_MOST 0.1    /* largest damping coefficient times the time step [1] */

#define FRAME_BYTES 60.0 /* size of a frame with its usual fields per particle; measured: 54 in 2D, 63 in 3D [byte] */
#define FRAMES_MANY 10e9 /* size of all frames from which on they are reported [byte] */

/* Returns true if the components of boundary b are given as numbers, none of them as a formula. */
static bool is_number(const struct boundary *b) { return b->formula[0].n + b->formula[1].n + b->formula[2].n == 0; }

/* Adds a hint to *to for each negative pressure of scene s (the input file), and for each pair of tractions on opposite
 * faces that push the body in one direction along the axis of the faces. Values given as formulas are skipped. */
static void hint_pushed(const struct scene *s, struct warnings *to)
{
    for (int k = 0; k < s->boundaries; k++) {
        const struct boundary *a = &s->boundary[k];
        if (a->kind == BOUNDARY_PRESSURE && is_number(a) && a->value[0] < 0)
            warnings_add_if_new(to,
                                "boundary %s: a pressure of %.3g Pa is negative and pulls the faces outwards; use a "
                                "positive one to push",
                                a->name, a->value[0]);
        for (int m = 0; m < k && a->kind == BOUNDARY_TRACTION && is_number(a); m++) {
            const struct boundary *b = &s->boundary[m];
            if (b->kind != BOUNDARY_TRACTION || !is_number(b) || b->face != a->face || b->side != -a->side) continue;
            if (!(a->value[a->face] * b->value[a->face] > 0) || a->body != b->body) continue;
            warnings_add_if_new(to,
                                "boundaries %s and %s: tractions of %.3g and %.3g Pa along %c on opposite faces push "
                                "the body in one direction; to stretch the body, give the tractions opposite signs",
                                b->name, a->name, b->value[a->face], a->value[a->face], "xyz"[a->face]);
        }
    }
}

/* Adds a hint to *to for each value of friction, gravity, damping (in dynamic problems) and width of a crack in the
 * input file of the run that exceeds a limit such as FRICTION_MOST, above which no real solid is known. */
static void hint_sizes(const struct run *run, struct warnings *to)
{
    const struct scene *s = run->scene;
    const real gravity = sqrt(dot(s->gravity, s->gravity, s->dim)) / EARTH;
    const real longest = particles_bounding_box_longest_edge(&run->part) + s->spacing;
    if (s->contact_friction > FRICTION_MOST)
        warnings_add_if_new(
            to, "contact.friction: %.3g is above %.2g; dry solids have 0.1 to 1.5; check its value (0.3 is 30 %%)",
            s->contact_friction, FRICTION_MOST);
    if (gravity > GRAVITY_MOST)
        warnings_add_if_new(to, "gravity: %.3g m/s^2 is %.3g times that of the Earth; check its unit (m/s^2)",
                            gravity * EARTH, gravity);
    if (s->damping * run->clock.dt > DAMPING_MOST && scene_is_dynamic(s))
        warnings_add_if_new(to,
                            "damping: at %.3g 1/s motion dies out within %.3g time steps, so nothing moves; give a "
                            "smaller value, about 1/T for vibrations of period T",
                            s->damping, 1 / (s->damping * run->clock.dt));
    for (int k = 0; k < s->cracks_given; k++)
        if (s->crack[k].width > longest)
            warnings_add_if_new(to,
                                "crack %d: its width of %.3g m is larger than the bodies, %.3g m; check its unit (m if "
                                "none is written)",
                                k + 1, s->crack[k].width, longest);
}

/* Adds a hint to *to if the frames of the run (outputs of all particles at one time) together take more than
 * FRAMES_MANY (10 GB) on the disk. */
static void hint_frames(const struct run *run, struct warnings *to)
{
    const double steps = (double)run->clock.steps, frames = run->scene->frames < steps ? run->scene->frames : steps;
    const double bytes = FRAME_BYTES * frames * (double)run->part.n;
    if (bytes > FRAMES_MANY)
        warnings_add_if_new(to,
                            "output.frames: %.0f frames of %lld particles take about %.2g GB of disk; write fewer, or "
                            "frames of a region (output.regions)",
                            frames, (long long)run->part.n, 1e-9 * bytes);
}

void hint_implausible_load_signs_and_magnitudes(const struct run *run, struct warnings *warning_list)
{
    hint_pushed(run->scene, warning_list);
    hint_sizes(run, warning_list);
    hint_frames(run, warning_list);
}
