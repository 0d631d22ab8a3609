"""The fixture that opens pages notices every error in them."""

import pytest

ELSEWHERE = "http://elsewhere.invalid/"
BAD_PAGES = {
    "console.error('lost')": "console error: lost",
    "console.warn('soon')": "console warning: soon",
    "throw new Error('uncaught here')": "uncaught here",
    "Promise.reject(new Error('rejected here'))": "rejected here",
    f"fetch('{ELSEWHERE}').catch(() => {{}})": f"request to {ELSEWHERE}",
    f"new Worker(URL.createObjectURL(new Blob(['fetch(`{ELSEWHERE}`).catch(() => 0)'])))": f"request to {ELSEWHERE}",
    "new Worker(URL.createObjectURL(new Blob(['console.error(`inside`)'])))": "console error: inside",
}


@pytest.mark.parametrize("script", BAD_PAGES)
def test_what_goes_wrong_in_a_page_is_seen(open_page, tmp_path, script):
    (tmp_path / "page.html").write_text(f'<!doctype html><link rel="icon" href="data:,"><script>{script}</script>')
    page = open_page(tmp_path, "page.html")
    for _ in range(3_000):
        if any(BAD_PAGES[script] in complaint for complaint in open_page.complaints):
            break
        page.wait_for_timeout(20)
    else:
        pytest.fail(f"{open_page.complaints}")
    page.close()
    open_page.complaints.clear()


def test_a_file_that_is_not_there_is_seen(open_page, tmp_path):
    (tmp_path / "page.html").write_text('<!doctype html><link rel="icon" href="data:,"><script src="lost.js"></script>')
    open_page(tmp_path, "page.html")
    assert any("404" in complaint for complaint in open_page.complaints)
    open_page.complaints.clear()
