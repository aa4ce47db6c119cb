"""Options of the core with fields changed: all others are kept, and nothing is changed in place."""

from __future__ import annotations

import pytest

from handey import _core
from handey.options import with_fields


def test_all_other_fields_are_kept() -> None:
    features = _core.FeatureOptions(jaw_clearance=0.0123)
    given = _core.RankingOptions(features=features, least_share=0.45, most_targets=7)
    changed = with_fields(given, use_destination=False)
    assert (changed.features.jaw_clearance, changed.least_share) == (0.0123, 0.45)
    assert (changed.most_targets, changed.use_destination) == (7, False)
    assert given.use_destination


def test_the_copy_does_not_share_its_nested_options() -> None:
    given = _core.ApproachOptions()
    changed = with_fields(given, search_levels=0)
    changed.slide.clearance = 0.5
    assert given.slide.clearance != 0.5 and given.search_levels != 0


def test_an_unknown_field_is_refused() -> None:
    with pytest.raises(TypeError):
        with_fields(_core.SamplingOptions(), speed=1.0)
