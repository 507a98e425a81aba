"""How well hulls fit what is shown, and which of them are oddly shaped, inside others, overlapping or apart."""

from meshforge.checks.fit.fit import Fit, HullFit, fit
from meshforge.checks.fit.pictures import fit_pictures
from meshforge.checks.fit.shape import oddities
from meshforge.checks.fit.skin import Skins

__all__ = ["Fit", "HullFit", "Skins", "fit", "fit_pictures", "oddities"]
