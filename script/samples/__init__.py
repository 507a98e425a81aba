"""Maker of the bundled tables: parametric parts, decomposed by CoACD, written as frozen data.

What holds for all fourteen, so that one program is right for them:
- every leg is a body of its own, and so is every drawer: no stretchers, gaps of centimetres between drawers;
- a box is the right support for every top; shelves lie far below it; legs and panels are balanced about the middle,
  so that the line from the legs' centre to the panels' is upright within a third of a degree;
- all hulls of a drawer's handle touch the drawer, and no other handle does.
"""
