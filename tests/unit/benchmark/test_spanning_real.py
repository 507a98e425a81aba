"""Real assets decomposed as a whole: their hulls, the surface that these stand for, and what is left out."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from benchmark.real.family import families, family
from benchmark.real.samples import make_sample
from benchmark.real.whole import REAL, list_hidden, list_whole, whole_sample
from benchmark.spanning.family import label_truly, make_pieces
from benchmark.spanning.real_assets import measure
from benchmark.spanning.sets import list_names, list_tasks, surface_of
from meshforge.common import AssetError
from tests.corpus_path import corpus


def test_without_the_corpus_one_message_says_what_to_set(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setenv("MESHFORGE_CORPUS", str(tmp_path / "nowhere"))
    with pytest.raises(AssetError, match=r"real_assets: not run: no corpus is here\n.*MESHFORGE_CORPUS"):
        measure(lambda line: None, True)


def test_assets_that_show_nothing_are_left_out_and_named() -> None:
    for name in families():
        assert sorted([*list_whole(name), *list_hidden(name)]) == sorted(family(name).names)
    assert [name for name in families() if list_hidden(name)] == ["cups"]
    assert list_names("cups", REAL) == list(list_whole("cups"))
    assert [task.difficulty for task in list_tasks("cups", REAL)] == ["easy", "medium", "hard"]


def test_a_real_chair_is_decomposed_as_a_whole_in_the_frame_of_its_file() -> None:
    corpus()
    sample = whole_sample("chairs", "kaykit-armchair")
    separate = make_sample(family("chairs"), "kaykit-armchair", "coarse")
    assert separate
    corners, other = (np.concatenate([h.vertices for h in one.mesh.hulls]) for one in (sample, separate))
    points, faces = surface_of(sample)
    for low_or_high in ("min", "max"):
        of_file = getattr(points, low_or_high)(axis=0)
        assert np.allclose(getattr(corners, low_or_high)(axis=0), of_file, atol=2e-3)
        assert np.allclose(getattr(other, low_or_high)(axis=0), of_file, atol=2e-3)
    assert faces.max() < len(points)
    assert sum(purity < 0.9 for purity in sample.purities) > sum(purity < 0.9 for purity in separate.purities)
    pieces = [piece.shape for piece in make_pieces(sample)]
    assert set(label_truly(pieces, sample.asset)) == {part.label for part in sample.asset.parts}
