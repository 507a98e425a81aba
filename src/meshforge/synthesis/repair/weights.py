"""What believing things costs, in nats, in one place: a program of some size, a label that is wrong.

Tuned on families of box furniture; judged by `script/bench repairs` on families that nothing was tuned on, with their
figures in `benchmark/results/learning.md`: nearly all proposals are right, and hardly any is made on right labels.
Without a batch around the demonstrations some 90% of the proposals are right.
"""

from __future__ import annotations

NODE = 1.8
"""A syntax node of an extractor: with five labels, the number of extractors grows so fast with their size."""

DOUBT = 1.0
"""A doubt of the search's order (`All`, a direction, an unusual contact)."""

NOTHING = 22.0
"""No extractor at all: what must not be exceeded to be proposed then."""

SERVING = 0.5
"""A correction, besides its improbability: so those are proposed that serve."""

SUREST = 5.0
"""What may speak for a correction at most; look-alikes err too."""

UNLABELLED = 1.5
"""Filling in a label where the hull has none, before look-alikes are asked."""

BELIEVED = 0.75
"""A proposal is made when each of its corrections is so probable."""

BELIEVED_WITHOUT = 0.3
"""The same where there is no exact extractor, so that nothing else is left."""

HUMAN_MOST = 0.5
"""A correction of a person's label is never believed more."""

UNSURE = 0.5
"""A machine's label is believed so much at least, whatever its confidence, before look-alikes are asked."""

SURE = (0.85, 0.98)
"""The most that a label of confidence 1 is believed lies between these; where, the batch tells for each source."""

AGREED = 0.85
"""Similar hulls that give a label such a chance tell whether others of the source are right."""

RIGHT_BEFORE = (0.96, 20.0)
"""The share of right labels that is assumed beforehand, and how many hulls that counts for."""

HUMAN = 0.9995
"""How much a person's label is believed."""

NEIGHBOURS = 20
"""Hulls asked how a hull like them is labelled: the most similar ones."""

REACH, FALL = 1.0, 3.0
"""A vote counts (1 + (d / REACH)^2)^-FALL at a distance of d standard deviations: what is far counts little, but where
nothing is near it is better than nothing (log loss of the true label 0.39 on two meshes instead of 0.64 for a Gaussian
that falls to nothing, 0.14 instead of 0.22 on 25)."""

SMOOTHING = 0.05
"""The share of the votes that is spread evenly over all labels."""

MENTIONED = 6
"""Of the most similar hulls so many are mentioned to the user."""

RIVAL = 4.0
"""Explanations that cost so much more than the best still take part when beliefs are shared out."""

NEGLIGIBLE = 8.0
"""Explanations that cost so much more than another are not even looked at."""
