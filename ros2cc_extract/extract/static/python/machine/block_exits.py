"""How a block of statements may end: a sum of these, several where a branch decides."""

NEXT, RETURN, BREAK, CONTINUE, DEAD = 1, 2, 4, 8, 16
LEAVING = RETURN | BREAK | CONTINUE
