"""What the tables of RQ1 mean, and where their figures flatter or miss their goal."""

from __future__ import annotations

from benchmark.evaluation import paper

NOTES = (
    paper.CONDITIONS,
    "*Families*: a demonstrator teaches on 25 different assets at one decomposition; the five get the medium, "
    "fine, coarse, medium and fine one. Where the column *people* says 3, one demonstrator for each decomposition "
    "teaches. *Union*, *welded*: one decomposition by a single CoACD call, in which hulls span parts.",
    "*The person* of all rows without a word after the colon helps the tool in no way: shows any mesh first, and "
    "another only while a rule has had nothing to do; looks at twelve results drawn at random; where one is wrong "
    "by the eye, for whatever reason, shows the whole edit again there; stops when all twelve are right, or after "
    "five demonstrations. *Kind person*: that of the first edition, who begins with the richest of a dozen meshes "
    "that the tool proposes, looks at the dozen that it proposes, reports what is right there, names the rule "
    "that failed, and passes over what the reference gets wrong too. The rows between change one of these.",
    "*The tool* is `meshforge.Project`, in every condition: each session has a project of its own on a disk, of meshes "
    "that were written as OBJ files and read back, so that their vertices are in the product's order. Demonstrations, "
    "answers and labels are written there, repairs and verdicts kept there, and learning reads them.",
    "*SSR*: tasks in which all demonstrators end with a program whose selections are the reference's on every "
    "mesh of the family that was not demonstrated, under the same labels. *Right if labels were*: on these meshes "
    "under true labels. *On all decompositions*: also on the other decompositions of these assets. *k*: "
    "demonstrations plus answers to the tool's questions, as in the paper; looks, confirmations, approvals and "
    "labels are not in it, and stand in the table of acts.",
    "*At k*: from so many demonstrations plus answers on, all programs of all demonstrators are right; the first "
    "edition counted a program that was right once, though a later demonstration changed it.",
    "*FPR*: share of the judged meshes (neither demonstrated nor labelled by hand) whose edit meets the task's "
    "criterion. Beside it the reference program under the labels that the session ended with, and under true "
    "ones. Under true labels a session that is right has the reference's FPR by construction: there it measures "
    "the tasks and the decomposition, not the tool; so it has no goal.",
    "*Labels*: a simulated labeller, 92% of hulls right, no measure of any model. *Telling*: wrong labels have "
    "0.67 confidence on average, right ones 0.9. *Flat*: both are drawn from one distribution. *Systematic*: in a "
    "third of the assets that have it one kind of part is called by the name of a kind that it touches; all else "
    "is right. *Propagated from n*: a person labels n meshes before, as advised, and looks through the labels of "
    "each mesh that is demonstrated; from none: nothing is labelled at the start.",
    "*Seconds* of a person are modelled by keystrokes at the prices below, fixed before anything was tuned; those "
    "of the tool are measured. They are never added. Time to write templates or the vocabulary is not counted.",
    "*Settled*: the tool says that all readings agree on the family. A question counts as much as a demonstration "
    "in k, though it takes a third of the time.",
    "All demonstrators give the orientation, so the tool's suggestion of another one, which nobody here would "
    "answer, is switched off; its time is not in the table.",
)
