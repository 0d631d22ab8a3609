"""What the pages need besides `neorl`.

`thesis` judges this one thesis, `shared` serves several pages, and each page has a folder of its toy systems and
figures, which may import all of `neorl` and the folders of chapters before it. `neorl` knows nothing of this one.
"""
