/* Computes the edit distance of two words. */
#include "base/edit_distance.h"

#include <string.h>

int edit_distance(const char *a, const char *b)
{
    enum { LONGEST = 48 };
    int row[3][LONGEST + 1], n = (int)strnlen(a, LONGEST), m = (int)strnlen(b, LONGEST);
    int *older = row[0], *old = row[1], *now = row[2];
    for (int j = 0; j <= m; j++) old[j] = j;
    for (int i = 1; i <= n; i++) {
        now[0] = i;
        for (int j = 1; j <= m; j++) {
            int best = old[j - 1] + (a[i - 1] != b[j - 1]);
            if (old[j] + 1 < best) best = old[j] + 1;
            if (now[j - 1] + 1 < best) best = now[j - 1] + 1;
            bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
            if (swapped && older[j - 2] + 1 < best) best = older[j - 2] + 1;
            now[j] = best;
        }
        int *spare = older;
        older = old, old = now, now = spare;
    }
    return old[m];
}

bool word_is_probable_misspelling_of(const char *word, const char *other_word)
{
    const size_t length = strlen(word), other_length = strlen(other_word);
    const size_t least = length < other_length ? length : other_length;
    const int distance = edit_distance(word, other_word);
    if (least < 2 || length + other_length < 5) return false;
    const bool same_ends = word[0] == other_word[0] && word[length - 1] == other_word[other_length - 1];
    return distance <= 1 || (distance == 2 && (least >= 8 || (least >= 5 && same_ends)));
}
