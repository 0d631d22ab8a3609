"""The guided tour operates the Explorer's real controls, stop by stop, by keyboard alone. All tests share one page."""

import pytest
from explorer_page import press, wait, write_page
from playwright.sync_api import expect

from neorl import Explorer, WaterWorld, place_cells, simulate

FIT = "Place and object-vector cells"


@pytest.fixture(scope="module")
def page(open_shared_page, tmp_path_factory):
    """A page whose condition is too short for the tour."""
    short = simulate(place_cells([3]), WaterWorld(), steps=1_000, runs=2, progress=False)
    folder = tmp_path_factory.mktemp("tour")
    write_page(folder, [Explorer({"short": short}, playing=False)])
    page = open_shared_page(folder, "page.html")
    wait(page, "paused")
    return page


def wait_for(page, condition):
    page.wait_for_function(f"""() => {{
        const {{ state, step, score, secondStep, secondScore }} = document.querySelector(".neorl-explorer").dataset;
        return {condition};
    }}""")


def test_it_starts_only_when_asked_to(page):
    expect(page.locator(".tour")).to_be_hidden()
    assert page.locator('[name="preset"]').input_value() == "short"
    page.evaluate("location.hash = '#explorer_start-tour'")
    wait(page, "running|ended")
    expect(page.locator(".tour")).to_be_hidden()


def test_its_stops_operate_the_controls_and_at_its_end_the_reader_is_where_it_started(page):
    page.evaluate("location.hash = '#explorer_agent-short_red-0p5_minute-0p1'")
    wait_for(page, "state === 'paused' && step === '300'")
    page.evaluate("document.body.insertAdjacentHTML('beforeend', '<button id=pst-back-to-top>Top</button>')")
    page.locator('[data-action="tour"]').press("Enter")
    expect(page.locator("#pst-back-to-top")).to_be_hidden()
    panel, status = page.get_by_role("region", name="Guided tour"), page.locator(".tour [role=status]")
    expect(status).to_contain_text("1 of 6: The blue disc is the agent.")
    expect(page.locator('[name="preset"]')).to_have_value(FIT)
    wait_for(page, "state === 'paused' && step === '0'")
    expect(page.locator(".pointed")).to_have_count(1)
    expect(panel.get_by_role("button", name="Next")).to_be_focused()

    page.keyboard.press("Enter")
    expect(status).to_contain_text("2 of 6: It knows nothing yet, so chance decides.")
    wait_for(page, "state === 'running' && Number(step) > 10")

    page.keyboard.press("Enter")
    expect(status).to_contain_text("3 of 6: 60,000 steps later")
    wait_for(page, "Number(step) > 60_000")
    expect(page.locator('[name="speed"]')).to_have_value("1")

    page.keyboard.press("Enter")
    expect(status).to_contain_text("4 of 6: The deeper the green")
    expect(page.get_by_label("Value", exact=True)).to_be_checked()
    expect(page.locator(".key")).to_contain_text("Green ground")

    page.keyboard.press("Enter")
    expect(status).to_contain_text("5 of 6:")
    expect(page.locator(".interest")).to_have_text("+1")
    expect(panel.get_by_role("button", name="Next")).to_be_focused()

    page.keyboard.press("Enter")
    expect(status).to_contain_text("6 of 6: Two tanks, one seed")
    expect(page.locator(".interest")).to_have_count(0)
    wait_for(page, "Number(secondStep) > 100 && secondStep === step")
    expect(page.locator(".named")).to_have_count(2)

    panel.get_by_role("button", name="Done").press("Enter")
    expect(panel).to_be_hidden()
    expect(page.locator('[data-action="tour"]')).to_be_focused()
    expect(page.locator(".pointed")).to_have_count(0)
    expect(page.locator(".second")).to_be_hidden()
    expect(page.get_by_label("Value", exact=True)).not_to_be_checked()
    wait_for(page, "state === 'paused' && step === '300'")
    expect(page.locator('[name="preset"]')).to_have_value("short")
    expect(page.locator('[name="valence_red"]')).to_have_value("0.5")
    expect(page.locator('[name="speed"]')).to_have_attribute("aria-valuetext", "20× real time")


@pytest.mark.parametrize("leave", ["Escape", "Stop"])
def test_it_can_be_left_at_any_stop(page, leave):
    press(page, "tour")
    expect(page.locator(".second")).to_be_hidden()
    page.keyboard.press("Enter")
    if leave == "Stop":
        page.get_by_role("button", name="Stop", exact=True).click()
    else:
        page.keyboard.press("Escape")
    expect(page.locator(".tour")).to_be_hidden()
    expect(page.locator('[data-action="tour"]')).to_be_focused()


def test_a_link_that_is_followed_on_the_way_is_not_taken_back_at_the_end(page):
    press(page, "tour")
    page.evaluate("location.hash = '#explorer_agent-short_start-veteran'")
    expect(page.locator(".second")).to_be_visible()
    page.get_by_role("button", name="Stop", exact=True).click()
    wait_for(page, "step === '1000' && secondStep === '1000'")
    expect(page.locator(".said")).to_contain_text("ahead.")


@pytest.mark.parametrize("width", [400, 1200])
def test_what_a_stop_points_at_and_the_tank_are_on_the_screen_and_not_below_the_tour(page, width):
    page.set_viewport_size({"width": width, "height": 800})
    page.evaluate("document.body.style.cssText = 'max-width: 1000px'")  # about the width of the book's pages
    press(page, "tour")
    for stop in range(1, 7):
        expect(page.locator(".tour [role=status]")).to_contain_text(f"{stop} of 6")
        page.wait_for_function("""() => {
            const { top } = document.querySelector(".tour").getBoundingClientRect();
            const [pointed, tank] = [".pointed", ".arena canvas"].map((each) =>
                document.querySelector(each).getBoundingClientRect());
            const hidden = Math.max(0, -tank.top) + Math.max(0, tank.bottom - top);
            return pointed.height > 0 && pointed.top >= 0 && pointed.bottom <= top && hidden < 0.1 * tank.height;
        }""")
        assert page.evaluate("document.documentElement.scrollWidth") <= width
        wait_for(page, "state !== 'loading'")
        page.locator('[data-action="next"]').click()
    expect(page.locator(".tour")).to_be_hidden()
