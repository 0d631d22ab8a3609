"""What the page "Is it general?" needs beside its experiments: rivals, yardsticks and recordings, and figures."""
