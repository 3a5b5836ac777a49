/* Parts of the load steps (quasistatic/statics.h) that the engine's files share. */
#ifndef CLEAVE_ENGINE_STATICS
#define CLEAVE_ENGINE_STATICS

#include "base/memory_archive.h"
#include "quasistatic/load_steps.h"
#include "output/column.h"
#include "quasistatic/statics.h"

/* Unknowns of the particles and nodes that there are, where they are; to be made anew after conversion. */
void statics_unknowns_make(struct run *e);
void statics_unknowns_free(struct run *e);
/* Reference place of a node of the unknowns [m]. */
void statics_node_place(const struct run *e, int64_t k, real *X);
/* Particles, nodes and their images go to these displacements [nodes, m]. */
void statics_place(struct run *e, const struct field *u);
/* Books the forces on supports, and where they are. */
void statics_react(struct run *e);
/* Bonds and points have yielded as they have now: trials of the next step begin from here; they have as they had
 * then. */
void statics_plastic_keep(struct run *e);
void statics_plastic_restore(struct run *e);
/* Particles and nodes, and what yields, are as in the equilibrium that has been found. */
void statics_flow(struct run *e);
/* Applied forces at pseudo-time t become those that act (balance.c). */
void statics_applied_make(struct run *e, real t);
/* Equilibrium under loads and supports of pseudo-time t [s], which becomes the time of the run; books work, what was
 * lost on the way, and reactions. FAILED with the place of the residual. */
status statics_solve(struct run *e, real t);

/* Norm of all that acts on free components but forces of bonds and cells [N] (balance.c). */
real statics_applied_norm(const struct run *e);

/* Contact and rigid bodies (touch.c). Can anything meet? Finds what touches at the start. Solutions on the way
 * to t without one of which a rigid body would go too far. Before a solution: bodies go to t, and what touches there
 * is marked. Settle and laws of equilibrium.h. After it: books the work of rigid bodies, and where something touches
 * what is lost, of `lost` before the solution and the work of loads and supports in it [J]; returns how far the work of
 * rigid bodies is from that by one of both forces [J]. Square of their way up to t [m^2]. What a trial changes, and as
 * it was. */
bool statics_meets(const struct run *e);
/* Does anything touch, at the beginning of a solution or now? */
bool statics_touched(const struct run *e);
void statics_touch_start(struct run *e);
int statics_strides(const struct run *e, real t);
void statics_touch_begin(struct run *e, real t);
bool statics_touch_settle(void *engine);
void statics_touch_laws(void *engine, bool settled);
real statics_touch_end(struct run *e, real work, real lost);
real statics_rigid_way2(const struct run *e, real t);
void statics_touch_take(struct run *e, struct memory_archive *m);
void statics_touch_give(struct run *e, struct memory_archive *m);

/* Pieces that nothing holds (pieces.c): finds them, by the bonds and supports of now; takes out of forces, or of
 * a way, what belongs to their motions as a whole. */
void statics_pieces_make(struct run *e);
void statics_pieces_free(struct run *e);
/* FAILED if loads would carry away a piece that nothing holds. */
status statics_unheld(const struct run *e);
void statics_pieces_hold(const struct run *e, struct field *v);
/* Signs of the components of an image's motion against those of the particle that it comes from, which is its
 * image_root; +1 of a particle that is none. */
void statics_image_signs(const struct run *e, int64_t i, real sign[DIM_MAX]);

/* Columns of history.csv (steps_record.c); column NULL: only their number; their values, of a load step that has
 * just been sampled; and what the next one goes on from. */
int statics_columns(const struct run *e, struct column *column);
void statics_record(struct run *e, real *record);
void statics_record_keep(struct run *e);

/* Preconditioner (springs.c): z = M^-1 r of equilibrium.h; it is made anew once solutions take too many
 * directions, or when it is to (`free`). */
void statics_precondition(void *engine, const struct field *r, struct field *z);
void statics_precondition_make(struct run *e);
void statics_precondition_watch(struct run *e, int64_t directions);
void statics_precondition_free(struct run *e);

/* Bonds over their limit (overload.c): the largest stretch of an intact bond over its limit [1]; breaks those
 * within `share` of the largest, `most` pairs or a few more that are alike, adds them to the list of the next advance
 * and what they hold at their limits to *cost [J], the area that they cross to *area [m^2]; returns directed bonds
 * broken. */
real statics_overload(const struct run *e);
int64_t statics_break(struct run *e, real share, int64_t most, real *cost, real *area);
/* Breaks the bonds of a list; makes them whole again. Saves or restores that of the next advance. */
void statics_break_listed(struct run *e, const struct break_list *l);
void statics_mend(struct run *e, const struct break_list *l);
/* Record of a bond of a row for such a list, with half of what a bond of a bond-based model holds at its limit [J]. */
void break_list_add(struct break_list *l, const struct broken_bond *record);
struct broken_bond statics_bond_record(const struct run *e, const struct bond *bond, int64_t row);
status statics_list_archive(struct run *e, struct archive *a);

/* Advances (advance.c). Equilibrium at pseudo-time t, with the overload there. Looks for the next advance unless
 * it is known: its bonds, and the size of loads at which it comes. Lets it come. Size of loads and supports at a
 * pseudo-time, which scales as they do; the pseudo-time near this one at which loads have a size; energy released so
 * far [J]. */
status statics_go(struct run *e, real t);
status statics_look_ahead(struct run *e);
/* Material points that have to become peridynamic do, until none has to; so many directed bonds have broken. */
status statics_convert(struct run *e, int64_t broken);
status statics_advance(struct run *e);
/* Its two parts: its bonds break, directed ones are counted; equilibrium, and conversion after so many. */
int64_t statics_advance_break(struct run *e);
status statics_advance_settle(struct run *e, int64_t broken);
/* The same where it pays for itself, which loads go to first. */
status statics_advance_balanced(struct run *e);
/* Lets the body go at the next advance, in time, until it is at rest again (release.c). */
status statics_release(struct run *e);
real statics_load_size(const struct run *e, real t);
real statics_time_of_size(const struct run *e, real size);
/* Work on a bond from where it bears nothing to a stretch `elastic` beyond its plastic one, over its stiffness and
 * length (the integral of its force over its stiffness by the stretch) [1]: the force goes with the stretch up to
 * `yield` [1], then on with the slope h/(1 + h) of the ratio h of `hardening` (plastic modulus over stiffness) [1], as
 * in a bar with linear isotropic hardening (Simo & Hughes 1998, 1.2). INFINITY: it never yields. */
real stretch_work(real elastic, real yield, real hardening);
real statics_released(const struct run *e);

/* What a trial has to give back. */
struct stand {
    real t, overload, lost, damped, work, constraint_work;
    struct field u, f;
    bool touches;
    struct memory_archive touch;
};
void stand_take(struct stand *k, struct run *e);
/* Gives it back, mends the bonds of a list (NULL: none are broken), and frees it. */
void stand_give(struct stand *k, struct run *e, const struct break_list *broken);
void stand_free(struct stand *k, const struct run *e);
/* Size of loads at which the costs and releases of two advances balance; INFINITY: at none. */
real size_of_balance(const struct advance *a, const struct advance *b);
/* The same of one: there it pays for itself. */
real size_of_advance(const struct advance *a);
/* The advance before the first one of a pre-crack, as if that had grown there: its release goes on as that of the
 * first two; none is less than 0. */
struct advance advance_before(const struct advance *first, const struct advance *second);
/* Energy per area that a crack takes between particles i and j: of bonds at their limits, of state-based models G_c as
 * given, of an interface, between materials, where strength scatters [J/m^2]. */
real toughness_between(const struct run *e, int64_t i, int64_t j);

/* Cracks that are led by their stress-intensity factors (led.c, led_cut.c), in a plane
 * (led_plane.c): finds it, and says why there is none, else NULL; where X of `dim` components lies in it [m]; a
 * pre-crack there, false: askew. Mean width of the body across it along a way [m]; area of a new face there [m^2]. Does
 * the way lie on a plane of symmetry? */
const char *led_plane_find(const struct run *e, struct led_plane *plane);
void led_project(const struct led_plane *plane, const real *X, int dim, real to[2]);
void led_project_particle(const struct run *e, int64_t i, real to[2]);
bool led_segment(const struct led_plane *plane, const struct crack *c, int dim, real at[2][DIM_MAX]);
real led_width(const struct run *e, const struct led_plane *plane, const real *from, const real *to);
real led_face_area(const struct run *e, const real *from, const real *to);
bool led_on_mirror(const struct run *e, const struct led_plane *plane, const real *from, const real *to);
/* Is there a tip to lead? */
bool led_leads(struct run *e);
/* Measures factors at a tip, in its frame; false: it sees too little. */
bool led_measure(const struct run *e, const struct led_tip *tip, real K[2]);
/* The place `way` ahead of another one in the plane of the tips, along a unit vector [m]. */
static inline void led_ahead(const real *place, real way, const real *along, real ahead[2])
{
    for (int d = 0; d < 2; d++) ahead[d] = place[d] + way * along[d];
}
/* Cuts what is left of bonds behind a tip that has been set beside its pre-crack, before anything is loaded. */
void led_free_behind(struct run *e, const struct led_tip *tip);
/* Where its next stretch ends [m]. */
void led_next_place(const struct run *e, const struct led_tip *tip, real place[2]);
/* What it costs [J/m^2]. */
real led_toughness(const struct run *e, const struct led_tip *tip);
/* Turns the tips to where they go next; moves one along its next stretch. */
void led_turn(const struct run *e, struct led_tip *tip);
void led_move(struct run *e, int tip);
/* Factors of the leading tip; NAN where there is none. */
void led_factors(struct run *e, real K[2]);
/* Where the tip that has gone farthest is, or the middle of its front, in the reference frame [m]; NAN: none is led. */
void led_place(const struct run *e, real place[DIM_MAX]);
void led_free(struct led *l);
status led_archive(struct run *e, struct archive *a);
/* The next advance of led cracks, and what follows it. */
status led_look_ahead(struct run *e);
void led_advance(struct run *e);
/* Bonds have broken by themselves: no tip is led from here on. */
void led_lose(struct run *e);

#endif
