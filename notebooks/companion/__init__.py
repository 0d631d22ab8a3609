"""What the pages need besides `neorl`.

`thesis` judges this one thesis, `page` is the toolkit of pages, `shared` has toy systems of several, and each page
has a folder of its own, which may import all of `neorl` and the folders of chapters before it. `neorl` knows nothing
of this one.
"""
