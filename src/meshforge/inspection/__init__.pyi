# Written by `python -m script.stubs`.
from meshforge.inspection.look import Difference as Difference
from meshforge.inspection.look import check as check
from meshforge.inspection.look import diff as diff
from meshforge.inspection.look import render as render
