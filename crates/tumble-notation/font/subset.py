"""Makes tumble-math.woff2, the page's font for formulas: New Computer Modern Math, reduced to characters.txt.

    python subset.py NewCMMath-Regular.otf     (needs fonttools and brotli)

Its licence asks that a changed font has another name.
"""

import sys
from pathlib import Path

from fontTools import subset

HERE = Path(__file__).parent
FAMILY = "Tumble Math"
# Glyph variants for sub- and superscripts; the MATH table is kept as a whole.
FEATURES = ["ssty"]
COPYRIGHT_AND_LICENCE = [0, 13, 14]


def main(source):
    options = subset.Options(
        flavor="woff2", layout_features=FEATURES, name_IDs=COPYRIGHT_AND_LICENCE, hinting=False, drop_tables=["FFTM", "PfEd"]
    )
    font = subset.load_font(source, options)
    wanted = [ord(c) for c in HERE.joinpath("characters.txt").read_text("utf-8").rstrip("\n")]
    missing = [chr(c) for c in wanted if c not in font.getBestCmap()]
    assert not missing, missing
    subsetter = subset.Subsetter(options)
    subsetter.populate(unicodes=wanted)
    subsetter.subset(font)
    rename(font)
    subset.save_font(font, HERE / "tumble-math.woff2", options)


def rename(font):
    postscript = FAMILY.replace(" ", "") + "-Regular"
    for number, text in {1: FAMILY, 2: "Regular", 4: FAMILY, 6: postscript}.items():
        font["name"].setName(text, number, 3, 1, 0x409)
    outlines = font["CFF "].cff
    outlines.fontNames[0] = postscript
    outlines[0].FullName = outlines[0].FamilyName = FAMILY


if __name__ == "__main__":
    main(sys.argv[1])
