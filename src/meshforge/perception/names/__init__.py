"""Labels read off names: by patterns, by the words in them, and by words that are nearly those of a label."""

from meshforge.perception.names.likeness import EXACT
from meshforge.perception.names.naming import NAMELESS, Names, Told, told
from meshforge.perception.names.patterns import Pattern, fitting, pattern_of
from meshforge.perception.names.saying import said
from meshforge.perception.names.words import words_of

__all__ = ["EXACT", "NAMELESS", "Names", "Pattern", "Told", "fitting", "pattern_of", "said", "told", "words_of"]
