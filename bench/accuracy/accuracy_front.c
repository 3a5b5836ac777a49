/* Pareto front of a set of points, and the cheapest point of sufficient accuracy. */
#include <math.h>

#include "accuracy.h"

static bool counts(const struct accuracy_dot *d) { return isfinite(d->time) && isfinite(d->error); }

static bool beats(const struct accuracy_dot *a, const struct accuracy_dot *b)
{
    return counts(a) && a->time <= b->time && a->error <= b->error && (a->time < b->time || a->error < b->error);
}

static bool on_front(const struct accuracy_dot *dot, int n, int k)
{
    if (!counts(&dot[k])) return false;
    for (int j = 0; j < n; j++)
        if (beats(&dot[j], &dot[k]) || (j < k && dot[j].time == dot[k].time && dot[j].error == dot[k].error))
            return false;
    return true;
}

int accuracy_find_pareto_front(const struct accuracy_dot *dot, int dot_count, int *front)
{
    int found = 0;
    for (int k = 0; k < dot_count; k++) {
        if (!on_front(dot, dot_count, k)) continue;
        int at = found++;
        for (; at > 0 && dot[front[at - 1]].time > dot[k].time; at--) front[at] = front[at - 1];
        front[at] = k;
    }
    return found;
}

int accuracy_index_of_fastest_point(const struct accuracy_dot *dot, int dot_count, double largest_error)
{
    int best = -1;
    for (int k = 0; k < dot_count; k++)
        if (counts(&dot[k]) && dot[k].error <= largest_error && (best < 0 || dot[k].time < dot[best].time)) best = k;
    return best;
}
